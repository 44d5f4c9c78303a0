// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crowdface/render/rgb8_image.h"

namespace crowdface {

struct SheetCell {
  Rgb8Image image;    ///< all of a sheet's are of one size
  std::string label;  ///< stands under the image, line by line, each made to fit
};

/// What the colours of heat maps mean, shown below all cells.
struct HeatLegend {
  double most_mm = 0;
  std::string title;
};

struct SheetOptions {
  int columns = 6;
  int rows = 0;            ///< 0: as many as the cells need; more than those leave blanks
  std::string title = {};  ///< on the left above the cells
  std::optional<HeatLegend> legend = std::nullopt;
  std::string note = {};  ///< on the right above the cells, such as "sheet 2 of 5"
};

/// Where things lie on a sheet, in pixels.
struct SheetLayout {
  int columns, rows;
  int cell_width, cell_height;
  int label_height, label_lines;
  int header_height, legend_height;
  int margin, gap;

  int width() const { return 2 * margin + columns * cell_width + (columns - 1) * gap; }
  int height() const {
    return header_height + rows * (cell_height + label_height) + (rows - 1) * gap + legend_height +
           margin;
  }
  int left(int cell) const { return margin + cell % columns * (cell_width + gap); }
  int top(int cell) const {
    return header_height + cell / columns * (cell_height + label_height + gap);
  }
};

/// What all cells of a sheet have in common.
struct CellSize {
  int width = 0, height = 0;  ///< pixels of the picture
  int label_lines = 1;
};

/// \throws BrokenPrecondition if there is no cell, or there are more of them than columns · rows;
///         InvalidInput if the sheet would have more than 65,500 pixels a side or 5·10⁸ in all.
SheetLayout layout_sheet(const CellSize& cell, std::size_t count, const SheetOptions& options);
/// The same for these cells. \throws InvalidInput also if they differ in size.
SheetLayout layout_sheet(std::span<const SheetCell> cells, const SheetOptions& options);

/// How many rows of such cells a sheet can have at most; 0: not even one.
int most_rows(const CellSize& cell, const SheetOptions& options);

/// Pictures in a grid, row by row, a label under each and a header above them all.
/// \throws InvalidInput as layout_sheet, MissingInput without the font.
Rgb8Image contact_sheet(std::span<const SheetCell> cells, const SheetOptions& options);

/// The same for pictures of different heights: each stands below those before it in the column that
/// ends first, so that no cell is left half empty. The rows of the options, and their legend, are not used.
Rgb8Image sheet_in_columns(std::span<const SheetCell> cells, const SheetOptions& options);

/// A picture made smaller, each pixel the mean of those it covers (in linear light).
/// \param width_px  1 … image.width; the height follows.
Rgb8Image shrunk(const Rgb8Image& image, int width_px);

/// The picture on a larger sheet of the sheets' background colour, in its upper left corner.
Rgb8Image padded(const Rgb8Image& image, int width_px, int height_px);

/// Pictures of one height side by side: several views of one face in one cell.
/// \throws BrokenPrecondition if there is none; InvalidInput if heights differ.
Rgb8Image side_by_side(std::span<const Rgb8Image> images);

}  // namespace crowdface
