// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crowdface/render/rgb8_image.h"

namespace crowdface {

/// One cell of a contact sheet: an image with a text below.
struct SheetCell {
  /// Image of the cell. The function contact_sheet needs images of equal size.
  Rgb8Image image;
  /// Text under the image. The font of a line that is too long is reduced until the line fits.
  std::string label;
};

/// Legend for the heat maps in the cells of a sheet: a colour scale from 0 to `max_mm`. The sheet
/// shows the legend below all cells.
struct HeatLegend {
  double max_mm = 0;  ///< largest value on the scale, in mm
  std::string title;  ///< text beside the scale
};

/// Grid and texts of a contact sheet.
struct SheetOptions {
  int columns = 6;
  int rows = 0;  ///< number of rows of cells; 0: as many as needed; unused cells stay blank
  std::string title = {};                           ///< text at the top left of the sheet
  std::optional<HeatLegend> legend = std::nullopt;  ///< legend of a heat map; empty: none
  std::string note = {};  ///< text at the top right of the sheet, such as "sheet 2 of 5"
};

/// Positions and sizes of the parts of a sheet, in pixels.
struct SheetLayout {
  int columns, rows;                 ///< numbers of columns and rows of cells
  int cell_width, cell_height;       ///< size of a cell's image
  int label_height, label_lines;     ///< label below each image: its height, number of text lines
  int header_height, legend_height;  ///< heights of the header and of the heat map's legend
  int margin, gap;                   ///< border around the sheet; space between cells

  /// Width of the sheet.
  int width() const { return 2 * margin + columns * cell_width + (columns - 1) * gap; }
  /// Height of the sheet.
  int height() const {
    return header_height + rows * (cell_height + label_height) + (rows - 1) * gap + legend_height +
           margin;
  }
  /// Left edge of a cell. Cells are counted row by row from 0.
  int left(int cell) const { return margin + cell % columns * (cell_width + gap); }
  /// Upper edge of a cell.
  int top(int cell) const {
    return header_height + cell / columns * (cell_height + label_height + gap);
  }
};

/// Size of a cell, the same for all cells of a sheet.
struct CellSize {
  int width = 0, height = 0;  ///< size of the cell's image, in pixels
  int label_lines = 1;        ///< number of text lines below the image
};

/// Computes the layout of a sheet with `count` cells.
/// \throws BrokenPrecondition if there are no cells, or more cells than columns · rows;
///         InvalidInput if the sheet would exceed 65,500 pixels on a side or 5·10⁸ pixels in all.
SheetLayout layout_sheet(const CellSize& cell, std::size_t count, const SheetOptions& options);
/// Computes the layout of a sheet with these cells.
/// \throws BrokenPrecondition, InvalidInput like the function above; also InvalidInput if the
///         cells' images differ in size.
SheetLayout layout_sheet(std::span<const SheetCell> cells, const SheetOptions& options);

/// Largest number of rows that a sheet with cells of this size can have; 0 if not even one row
/// fits.
int max_rows(const CellSize& cell, const SheetOptions& options);

/// Draws the cells in a grid, row by row, with a label under each cell and a header above the grid.
/// \throws InvalidInput like layout_sheet; MissingInput if the font is not installed.
Rgb8Image contact_sheet(std::span<const SheetCell> cells, const SheetOptions& options);

/// Like contact_sheet, for images of different heights: adds each image to the column that is
/// shortest so far. Ignores `rows` and `legend` of the options.
Rgb8Image sheet_in_columns(std::span<const SheetCell> cells, const SheetOptions& options);

/// Scales an image down by box filtering in linear light.
/// \param width_px  1 … image.width; the height keeps the aspect ratio.
Rgb8Image shrink_picture(const Rgb8Image& image, int width_px);

/// Pads an image to `width_px` by `height_px`: the image stays in the upper left corner, and the
/// new area gets the background colour of the sheets.
Rgb8Image pad_picture(const Rgb8Image& image, int width_px, int height_px);

/// Joins images of equal height side by side, so that one cell can show several views of a face.
/// \throws BrokenPrecondition if there are no images; InvalidInput if the heights differ.
Rgb8Image joined_pictures(std::span<const Rgb8Image> images);

}  // namespace crowdface
