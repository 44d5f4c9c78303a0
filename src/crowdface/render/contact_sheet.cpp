// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/contact_sheet.h"

#include <algorithm>
#include <array>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/render/text_label.h"

namespace crowdface {
namespace {

constexpr std::array<std::uint8_t, 3> kPaper = {34, 35, 37};
constexpr int kLargestSide = 65500;

void paste(const Rgb8Image& from, Rgb8Image& onto, int left, int top) {
  for (int y = 0; y < from.height; ++y) {
    std::copy_n(from.at(0, y), 3 * from.width, onto.at(left, top + y));
  }
}

void draw_header(Rgb8Image& sheet, const SheetLayout& layout, const SheetOptions& options) {
  const int inner = layout.width() - 2 * layout.margin;
  LabelStyle style;
  style.paper = kPaper;
  style.text_px = layout.header_height * 2 / 5;
  style.align = TextAlign::kLeft;
  const int title_width = options.note.empty() ? inner : inner * 2 / 3;
  paste(label_strip(options.title, title_width, layout.header_height, style), sheet, layout.margin,
        0);
  if (options.note.empty()) return;
  style.text_px = layout.header_height * 3 / 10;
  style.text = {150, 151, 154};
  style.align = TextAlign::kRight;
  paste(label_strip(options.note, inner - title_width, layout.header_height, style), sheet,
        layout.margin + title_width, 0);
}

}  // namespace

SheetLayout layout_sheet(std::span<const SheetCell> cells, const SheetOptions& options) {
  if (cells.empty()) throw InvalidInput("a contact sheet needs at least one picture");
  if (options.columns < 1 || options.rows < 0) {
    throw InvalidInput(concat("a contact sheet needs at least one column, found ", options.columns,
                              " columns and ", options.rows, " rows"));
  }
  const Rgb8Image& first = cells.front().image;
  for (const SheetCell& cell : cells) {
    if (cell.image.width == first.width && cell.image.height == first.height) continue;
    throw InvalidInput(concat("the pictures of a contact sheet are of one size: expected ",
                              first.width, " x ", first.height, ", found ", cell.image.width, " x ",
                              cell.image.height, " for ", quoted(cell.label)));
  }
  const auto count = static_cast<std::ptrdiff_t>(cells.size());
  const std::ptrdiff_t rows =
      options.rows > 0 ? options.rows : (count + options.columns - 1) / options.columns;
  if (count > rows * options.columns) {
    throw InvalidInput(concat("a contact sheet of ", options.columns, " x ", rows,
                              " cells cannot hold ", count, " pictures"));
  }
  const int size = std::min(first.height, first.width);
  const int label = std::clamp(size / 10, 12, 64);
  const std::ptrdiff_t widest = std::max<std::ptrdiff_t>(
      std::ptrdiff_t{options.columns} * (first.width + 64), rows * (first.height + label + 64));
  if (widest > kLargestSide) {
    throw InvalidInput(concat("a contact sheet of ", options.columns, " x ", rows, " cells of ",
                              first.width, " x ", first.height, " pixels is too large; at most ",
                              kLargestSide, " pixels a side"));
  }
  const bool header = !options.title.empty() || !options.note.empty();
  const int margin = std::clamp(size / 16, 6, 32);
  const int header_height = header ? std::clamp(size / 5, 24, 96) : margin;
  return {options.columns, static_cast<int>(rows), first.width, first.height,
          label,           header_height,          margin,      std::clamp(size / 32, 3, 16)};
}

Rgb8Image contact_sheet(std::span<const SheetCell> cells, const SheetOptions& options) {
  const SheetLayout layout = layout_sheet(cells, options);
  Rgb8Image sheet(layout.width(), layout.height(), kPaper);
  if (!options.title.empty() || !options.note.empty()) draw_header(sheet, layout, options);
  LabelStyle style;
  style.paper = kPaper;
  style.text_px = std::max(9, layout.label_height * 11 / 20);
  // Each cell is written by one task only.
  parallel_for_each(static_cast<std::ptrdiff_t>(cells.size()), [&](std::ptrdiff_t i) {
    const int cell = static_cast<int>(i);
    const SheetCell& content = cells[static_cast<std::size_t>(i)];
    paste(content.image, sheet, layout.left(cell), layout.top(cell));
    paste(label_strip(content.label, layout.cell_width, layout.label_height, style), sheet,
          layout.left(cell), layout.top(cell) + layout.cell_height);
  });
  return sheet;
}

Rgb8Image side_by_side(std::span<const Rgb8Image> images) {
  if (images.empty()) throw InvalidInput("there is no picture to put beside another");
  int width = 0;
  for (const Rgb8Image& image : images) {
    if (image.height != images[0].height) {
      throw InvalidInput(concat("pictures side by side are of one height: expected ",
                                images[0].height, ", found ", image.height));
    }
    width += image.width;
  }
  Rgb8Image out(width, images[0].height);
  int left = 0;
  for (const Rgb8Image& image : images) {
    paste(image, out, left, 0);
    left += image.width;
  }
  return out;
}

}  // namespace crowdface
