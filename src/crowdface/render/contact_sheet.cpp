// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/render/heat_colours.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/text_label.h"

namespace crowdface {
namespace {

constexpr std::array<std::uint8_t, 3> kBackground = {34, 35, 37};
constexpr int kLargestSide = 65500;
constexpr std::int64_t kMaxPixels = 500'000'000;

int lines_of(const std::string& label) {
  return 1 + static_cast<int>(std::count(label.begin(), label.end(), '\n'));
}

/// Draws the lines of a label, the first line in the brightest colour.
void draw_label(const std::string& label, Rgb8Image& sheet, const SheetLayout& layout, int left,
                int top) {
  const int line_height = layout.label_height / layout.label_lines;
  LabelStyle style;
  style.background_colour = kBackground;
  style.text_px = std::max(9, line_height * 13 / 20);
  for (std::size_t begin = 0; begin <= label.size(); top += line_height) {
    const std::size_t end = std::min(label.find('\n', begin), label.size());
    sheet.paste(
        label_strip(label.substr(begin, end - begin), layout.cell_width, line_height, style), left,
        top);
    style.text_colour = {160, 161, 164};
    begin = end + 1;
  }
}

void draw_header(Rgb8Image& sheet, const SheetLayout& layout, const SheetOptions& options) {
  const int inner = layout.width() - 2 * layout.margin;
  LabelStyle style;
  style.background_colour = kBackground;
  style.text_px = layout.header_height * 2 / 5;
  style.align = TextAlign::kLeft;
  const int title_width = options.note.empty() ? inner : inner * 2 / 3;
  sheet.paste(label_strip(options.title, title_width, layout.header_height, style), layout.margin,
              0);
  if (options.note.empty()) return;
  style.text_px = layout.header_height * 3 / 10;
  style.text_colour = {150, 151, 154};
  style.align = TextAlign::kRight;
  sheet.paste(label_strip(options.note, inner - title_width, layout.header_height, style),
              layout.margin + title_width, 0);
}

/// Returns the common size of the cells. \throws InvalidInput if the images differ in size.
CellSize size_of(std::span<const SheetCell> cells) {
  CellSize size;
  for (const SheetCell& cell : cells) {
    if (size.width == 0) size = {cell.image.width, cell.image.height, 1};
    size.label_lines = std::max(size.label_lines, lines_of(cell.label));
    if (cell.image.width == size.width && cell.image.height == size.height) continue;
    throw InvalidInput(concat("the pictures of a contact sheet must have the same size: expected ",
                              size.width, " x ", size.height, ", found ", cell.image.width, " x ",
                              cell.image.height, " for ", quoted(cell.label)));
  }
  return size;
}

/// Computes the layout of a sheet. \param options  `rows` must be set.
SheetLayout place_cells(const CellSize& cell, const SheetOptions& options) {
  const int size = std::min(cell.height, cell.width);
  const int line = std::clamp(size / (cell.label_lines > 1 ? 12 : 10), 12, 64);
  const bool header = !options.title.empty() || !options.note.empty();
  const int margin = std::clamp(size / 16, 6, 32);
  const int header_height = header ? std::clamp(size / 5, 24, 96) : margin;
  const int legend_height = options.legend ? std::clamp(size / 4, 32, 96) : 0;
  return {
      options.columns,  options.rows,  cell.width,    cell.height, cell.label_lines * line,
      cell.label_lines, header_height, legend_height, margin,      std::clamp(size / 32, 3, 16)};
}

bool is_small_enough(const SheetLayout& layout) {
  const std::int64_t columns = layout.columns, rows = layout.rows;
  if (columns * layout.cell_width > kLargestSide || rows * layout.cell_height > kLargestSide ||
      rows * layout.label_height > kLargestSide) {
    return false;  // check before the sizes below could overflow
  }
  const std::int64_t width = layout.width(), height = layout.height();
  return width <= kLargestSide && height <= kLargestSide && width * height <= kMaxPixels;
}

}  // namespace

SheetLayout layout_sheet(const CellSize& cell, std::size_t count, const SheetOptions& options) {
  require(count > 0 && options.columns >= 1 && options.rows >= 0, "contact sheet: ", count,
          " pictures in ", options.columns, " columns and ", options.rows, " rows");
  const auto columns = static_cast<std::size_t>(options.columns);
  const std::size_t rows =
      options.rows > 0 ? static_cast<std::size_t>(options.rows) : (count + columns - 1) / columns;
  require(count <= rows * columns, "contact sheet: ", count, " pictures in ", columns, " x ", rows,
          " cells");
  SheetOptions whole = options;
  whole.rows = static_cast<int>(std::min<std::size_t>(rows, kLargestSide));
  const SheetLayout layout = place_cells(cell, whole);
  if (rows > kLargestSide || !is_small_enough(layout)) {
    throw InvalidInput(concat("a contact sheet of ", columns, " x ", rows, " cells of ", cell.width,
                              " x ", cell.height, " pixels is too large; at most ", kLargestSide,
                              " pixels a side and ", kMaxPixels, " in all"));
  }
  return layout;
}

SheetLayout layout_sheet(std::span<const SheetCell> cells, const SheetOptions& options) {
  return layout_sheet(size_of(cells), cells.size(), options);
}

int max_rows(const CellSize& cell, const SheetOptions& options) {
  SheetOptions trial = options;
  int fits = 0, too_many = kLargestSide;
  while (too_many - fits > 1) {
    trial.rows = std::midpoint(fits, too_many);
    (is_small_enough(place_cells(cell, trial)) ? fits : too_many) = trial.rows;
  }
  return fits;
}

Rgb8Image contact_sheet(std::span<const SheetCell> cells, const SheetOptions& options) {
  const SheetLayout layout = layout_sheet(cells, options);
  Rgb8Image sheet(layout.width(), layout.height(), kBackground);
  if (!options.title.empty() || !options.note.empty()) draw_header(sheet, layout, options);
  if (options.legend) {
    const int width = std::min(layout.width() - 2 * layout.margin, 900);
    const int margin = layout.legend_height / 6;
    sheet.paste(heat_scale(options.legend->max_mm, options.legend->title, width,
                           layout.legend_height - margin, kBackground),
                layout.margin, layout.height() - layout.margin - layout.legend_height + margin);
  }
  // Safe in parallel: no two tasks write the same pixels.
  parallel_for_each(static_cast<int>(cells.size()), [&](int cell) {
    const SheetCell& content = cells[static_cast<std::size_t>(cell)];
    const int left = layout.left(cell), top = layout.top(cell);
    sheet.paste(content.image, left, top);
    draw_label(content.label, sheet, layout, left, top + layout.cell_height);
  });
  return sheet;
}

Rgb8Image sheet_in_columns(std::span<const SheetCell> cells, const SheetOptions& options) {
  require(!cells.empty() && options.columns >= 1, "sheet in columns: ", cells.size(),
          " pictures in ", options.columns, " columns");
  CellSize size;
  for (const SheetCell& cell : cells) {
    size = {std::max(size.width, cell.image.width), std::max(size.height, cell.image.height),
            std::max(size.label_lines, lines_of(cell.label))};
  }
  SheetOptions one_row = options;
  one_row.rows = 1;
  const SheetLayout layout = place_cells(size, one_row);
  std::vector<int> ends(static_cast<std::size_t>(options.columns), layout.header_height);
  std::vector<std::pair<int, int>> places;  // column, top
  for (const SheetCell& cell : cells) {
    const auto end = std::min_element(ends.begin(), ends.end());
    places.emplace_back(static_cast<int>(end - ends.begin()), *end);
    *end += cell.image.height + layout.label_height + layout.gap;
  }
  const int bottom = *std::max_element(ends.begin(), ends.end()) - layout.gap + layout.margin;
  Rgb8Image sheet(layout.width(), bottom, kBackground);
  if (!options.title.empty() || !options.note.empty()) draw_header(sheet, layout, options);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int left = layout.left(places[i].first), top = places[i].second;
    sheet.paste(cells[i].image, left, top);
    draw_label(cells[i].label, sheet, layout, left, top + cells[i].image.height);
  }
  return sheet;
}

Rgb8Image shrink_picture(const Rgb8Image& image, int width_px) {
  require(width_px >= 1 && width_px <= image.width, "shrink ", image.width, " pixels to ",
          width_px);
  const int height_px =
      std::max(1, static_cast<int>(std::int64_t{image.height} * width_px / image.width));
  const std::array<float, 256>& linear = linear_of_srgb8();
  Rgb8Image small(width_px, height_px);
  const auto from = [](int at, int of, int whole) {
    return static_cast<int>(std::int64_t{at} * whole / of);
  };
  parallel_for_each(height_px, 16, [&](int y) {
    for (int x = 0; x < width_px; ++x) {
      LinearRgb sum = LinearRgb::Zero();
      int count = 0;
      for (int v = from(y, height_px, image.height); v < from(y + 1, height_px, image.height);
           ++v) {
        for (int u = from(x, width_px, image.width); u < from(x + 1, width_px, image.width); ++u) {
          const std::uint8_t* p = image.at(u, v);
          sum += LinearRgb(linear[p[0]], linear[p[1]], linear[p[2]]);
          ++count;
        }
      }
      const Eigen::Array3f colour = to_srgb(sum / static_cast<float>(count));
      for (int c = 0; c < 3; ++c) {
        small.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
      }
    }
  });
  return small;
}

Rgb8Image pad_picture(const Rgb8Image& image, int width_px, int height_px) {
  require(image.width <= width_px && image.height <= height_px, "pad ", image.width, " x ",
          image.height, " pixels to ", width_px, " x ", height_px);
  Rgb8Image sheet(width_px, height_px, kBackground);
  sheet.paste(image, 0, 0);
  return sheet;
}

Rgb8Image joined_pictures(std::span<const Rgb8Image> images) {
  require(!images.empty(), "no picture to put beside another");
  int width = 0;
  for (const Rgb8Image& image : images) {
    if (image.height != images[0].height) {
      throw InvalidInput(concat("pictures side by side must have the same height: expected ",
                                images[0].height, ", found ", image.height));
    }
    width += image.width;
  }
  Rgb8Image out(width, images[0].height);
  int left = 0;
  for (const Rgb8Image& image : images) {
    out.paste(image, left, 0);
    left += image.width;
  }
  return out;
}

}  // namespace crowdface
