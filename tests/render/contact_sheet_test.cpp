// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/contact_sheet.h"

#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/render/text_label.h"

namespace crowdface {
namespace {

constexpr std::array<std::uint8_t, 3> kRed = {200, 30, 30};

std::vector<SheetCell> red_cells(std::size_t count, int width = 60, int height = 50) {
  std::vector<SheetCell> cells(count);
  for (std::size_t i = 0; i < count; ++i) {
    cells[i] = {Rgb8Image(width, height, kRed), "face_" + std::to_string(i)};
  }
  return cells;
}

/// Whether every pixel of the columns left and right of `from` to `to` is background.
bool is_blank(const Rgb8Image& image, int from, int to, const LabelStyle& style) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = from; x < to; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (image.at(x, y)[c] != style.background_colour[c]) return false;
      }
    }
  }
  return true;
}

TEST(SheetLayout, SizeIsCellsLabelsGapsAndMargins) {
  const auto cells = red_cells(7);
  const SheetLayout layout = layout_sheet(cells, {.columns = 3, .title = "market"});
  EXPECT_EQ(layout.rows, 3);
  EXPECT_EQ(layout.width(), 2 * layout.margin + 3 * 60 + 2 * layout.gap);
  EXPECT_EQ(layout.height(),
            layout.header_height + 3 * (50 + layout.label_height) + 2 * layout.gap + layout.margin);
  const Rgb8Image sheet = contact_sheet(cells, {.columns = 3, .title = "market"});
  EXPECT_EQ(sheet.width, layout.width());
  EXPECT_EQ(sheet.height, layout.height());
}

TEST(SheetLayout, FixedRowsKeepTheLastPageAsLargeAsTheOthers) {
  const auto full = red_cells(6);
  const auto part = red_cells(2);
  const SheetOptions options = {.columns = 3, .rows = 2};
  EXPECT_EQ(layout_sheet(full, options).height(), layout_sheet(part, options).height());
}

TEST(ContactSheet, PicturesStandInTheirCellsAndNowhereElse) {
  const auto cells = red_cells(5);
  const SheetOptions options = {.columns = 2, .title = "market", .note = "sheet 1 of 1"};
  const SheetLayout layout = layout_sheet(cells, options);
  const Rgb8Image sheet = contact_sheet(cells, options);
  int red = 0;
  for (int y = 0; y < sheet.height; ++y) {
    for (int x = 0; x < sheet.width; ++x) {
      red += std::equal(kRed.begin(), kRed.end(), sheet.at(x, y)) ? 1 : 0;
    }
  }
  EXPECT_EQ(red, 5 * 60 * 50);
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(std::equal(kRed.begin(), kRed.end(), sheet.at(layout.left(i), layout.top(i))));
    EXPECT_TRUE(
        std::equal(kRed.begin(), kRed.end(), sheet.at(layout.left(i) + 59, layout.top(i) + 49)));
  }
}

// Under the pages of families, which are flat, the index had a gap as high as a page of faces.
TEST(SheetInColumns, LeavesNoGapUnderFlatPictures) {
  std::vector<SheetCell> cells = red_cells(1, 60, 200);
  for (const SheetCell& flat : red_cells(5, 60, 30)) cells.push_back(flat);
  const SheetOptions options = {.columns = 2, .title = "index", .note = "6 sheets"};
  const SheetLayout layout = layout_sheet(CellSize{60, 200, 1}, 2, options);
  const Rgb8Image sheet = sheet_in_columns(cells, options);
  EXPECT_EQ(sheet.width, layout.width());
  const int below = layout.label_height + layout.gap;
  EXPECT_EQ(sheet.height, layout.header_height + std::max(200 + below, 5 * (30 + below)) -
                              layout.gap + layout.margin)
      << "the five flat ones stand beside the tall one";
  const auto is_red = [&](int x, int y) { return sheet.at(x, y)[0] == kRed[0]; };
  for (int i = 0; i < 5; ++i) {
    const int top = layout.header_height + i * (30 + below);
    EXPECT_TRUE(is_red(layout.left(1), top) && is_red(layout.left(1) + 59, top + 29)) << i;
    EXPECT_FALSE(is_red(layout.left(1), top + 30)) << i;
  }
  EXPECT_TRUE(is_red(layout.left(0), layout.header_height + 199));
}

TEST(ContactSheet, ALabelChangesOnlyItsStrip) {
  auto cells = red_cells(4);
  const SheetOptions options = {.columns = 2};
  const SheetLayout layout = layout_sheet(cells, options);
  const Rgb8Image before = contact_sheet(cells, options);
  cells[3].label = "another";
  const Rgb8Image after = contact_sheet(cells, options);
  bool changed = false;
  for (int y = 0; y < after.height; ++y) {
    for (int x = 0; x < after.width; ++x) {
      if (std::equal(after.at(x, y), after.at(x, y) + 3, before.at(x, y))) continue;
      changed = true;
      EXPECT_GE(x, layout.left(3));
      EXPECT_LT(x, layout.left(3) + layout.cell_width);
      EXPECT_GE(y, layout.top(3) + layout.cell_height);
      EXPECT_LT(y, layout.top(3) + layout.cell_height + layout.label_height);
    }
  }
  EXPECT_TRUE(changed);
}

TEST(ContactSheet, ThreadCountChangesNothing) {
  const auto cells = red_cells(9);
  const SheetOptions options = {.columns = 3, .title = "t", .note = "n"};
  const Rgb8Image many = contact_sheet(cells, options);
  const ThreadLimit one(1);
  EXPECT_EQ(contact_sheet(cells, options), many);
}

TEST(SheetLayout, HasAsManyRowsAsFitAndNoMore) {
  const SheetOptions options = {.columns = 3, .title = "market"};
  for (const CellSize cell : {CellSize{60, 50, 1}, CellSize{2048, 2048, 3}, CellSize{20'000, 32, 1},
                              CellSize{22'000, 32, 1}, CellSize{32, 65'400, 1},
                              CellSize{2'000'000'000, 2'000'000'000, 40'000}}) {
    const int rows = max_rows(cell, options);
    SheetOptions fixed = options;
    if (rows > 0) {
      fixed.rows = rows;
      const SheetLayout layout = layout_sheet(cell, 1, fixed);
      EXPECT_LE(layout.width(), 65'500);
      EXPECT_LE(layout.height(), 65'500);
      EXPECT_LE(std::int64_t{layout.width()} * layout.height(), 500'000'000);
    }
    fixed.rows = rows + 1;
    EXPECT_THROW(layout_sheet(cell, 1, fixed), InvalidInput) << cell.width;
  }
  EXPECT_EQ(max_rows({60, 50, 1}, {.columns = 2000}), 0);
}

TEST(ContactSheet, RefusesWhatDoesNotFit) {
  auto cells = red_cells(4);
  EXPECT_THROW(contact_sheet({}, {}), BrokenPrecondition);
  EXPECT_THROW(contact_sheet(cells, {.columns = 0}), BrokenPrecondition);
  EXPECT_THROW(contact_sheet(cells, {.columns = 1, .rows = 3}), BrokenPrecondition);
  EXPECT_THROW(contact_sheet(cells, {.columns = 1'000'000}), InvalidInput);
  cells[2].image = Rgb8Image(61, 50);
  EXPECT_THROW(contact_sheet(cells, {}), InvalidInput);
}

TEST(LabelStrip, ALongTextFitsAndKeepsBothEnds) {
  const LabelStyle style;
  const std::string start(40, 'W');
  const Rgb8Image strip = label_strip(start + "_0001", 120, 20, style);
  EXPECT_TRUE(is_blank(strip, 0, 3, style));
  EXPECT_TRUE(is_blank(strip, 117, 120, style));
  EXPECT_FALSE(is_blank(strip, 3, 117, style));
  EXPECT_NE(strip, label_strip(start + "_0002", 120, 20, style));  // the number at the end shows
}

TEST(LabelStrip, ATextThatNearlyFitsShrinks) {
  const LabelStyle style;
  const Rgb8Image strip = label_strip("market_smith_0123", 128, 20, style);
  EXPECT_TRUE(is_blank(strip, 0, 3, style));
  EXPECT_TRUE(is_blank(strip, 125, 128, style));
}

TEST(LabelStrip, AlignsWithinTheStrip) {
  LabelStyle style;
  style.align = TextAlign::kLeft;
  EXPECT_TRUE(is_blank(label_strip("abc", 200, 20, style), 100, 200, style));
  style.align = TextAlign::kRight;
  EXPECT_TRUE(is_blank(label_strip("abc", 200, 20, style), 0, 100, style));
}

TEST(LabelStrip, AccentsAndForeignLettersAreDrawnAndUnknownOnesMarked) {
  const LabelStyle style;
  EXPECT_NE(label_strip("Jos\xc3\xa9", 100, 20, style), label_strip("Jose", 100, 20, style));
  EXPECT_NE(label_strip("\xd0\x96", 100, 20, style), label_strip("?", 100, 20, style));
  EXPECT_EQ(label_strip("a\xe4\xb8\xad", 100, 20, style), label_strip("a?", 100, 20, style));
  EXPECT_EQ(label_strip("a\xff", 100, 20, style), label_strip("a?", 100, 20, style));
  EXPECT_EQ(label_strip("a\tb", 100, 20, style), label_strip("a b", 100, 20, style));
}

TEST(LabelStrip, TinyStripsStayEmpty) {
  const LabelStyle style;
  const Rgb8Image strip = label_strip("market_0001", 9, 7, style);
  EXPECT_EQ(strip.width, 9);
  EXPECT_EQ(strip.height, 7);
  EXPECT_TRUE(is_blank(label_strip("", 50, 20, style), 0, 50, style));
}

TEST(SideBySide, PutsViewsInARow) {
  const std::vector<Rgb8Image> views = {Rgb8Image(3, 2, {1, 1, 1}), Rgb8Image(5, 2, {9, 9, 9})};
  const Rgb8Image row = joined_pictures(views);
  EXPECT_EQ(row.width, 8);
  EXPECT_EQ(row.at(2, 1)[0], 1);
  EXPECT_EQ(row.at(3, 1)[0], 9);
  const std::vector<Rgb8Image> unequal = {Rgb8Image(3, 2), Rgb8Image(3, 3)};
  EXPECT_THROW(joined_pictures(unequal), InvalidInput);
  EXPECT_THROW(joined_pictures({}), BrokenPrecondition);
}

TEST(ContactSheet, LabelsOfSeveralLinesStandBelowEachOther) {
  auto cells = red_cells(2, 120, 100);
  cells[0].label = "face_1\non head_3\nnear face_2, 1.50 mm";
  const SheetOptions options = {.columns = 2};
  const SheetLayout layout = layout_sheet(cells, options);
  EXPECT_EQ(layout.label_lines, 3);
  const Rgb8Image sheet = contact_sheet(cells, options);
  const int line = layout.label_height / 3;
  for (int k = 0; k < 3; ++k) {
    const int top = layout.top(0) + layout.cell_height + k * line;
    bool written = false;
    for (int y = top; y < top + line; ++y) {
      for (int x = layout.left(0); x < layout.left(0) + layout.cell_width; ++x) {
        written |= sheet.at(x, y)[0] > 100;
      }
    }
    EXPECT_TRUE(written) << "line " << k;
  }
}

TEST(ContactSheet, LegendStandsBelowAllCells) {
  const auto cells = red_cells(4, 120, 100);
  SheetOptions options = {.columns = 2};
  const SheetLayout plain = layout_sheet(cells, options);
  options.legend = HeatLegend{6, "distance from its target"};
  const SheetLayout layout = layout_sheet(cells, options);
  EXPECT_EQ(layout.height(), plain.height() + layout.legend_height);
  EXPECT_EQ(layout.top(3), plain.top(3));
  EXPECT_EQ(contact_sheet(cells, options).height, layout.height());
}

TEST(Shrunk, KeepsOneColourAndMixesTwoInLinearLight) {
  EXPECT_EQ(shrink_picture(Rgb8Image(90, 60, kRed), 30), Rgb8Image(30, 20, kRed));
  Rgb8Image stripes(40, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; x += 2) {
      for (int c = 0; c < 3; ++c) stripes.at(x, y)[c] = 255;
    }
  }
  EXPECT_NEAR(shrink_picture(stripes, 20).at(7, 7)[1], 188, 1);  // half the light of white
  EXPECT_THROW(shrink_picture(stripes, 41), BrokenPrecondition);
}

TEST(Padded, KeepsThePictureInItsCorner) {
  const Rgb8Image sheet = pad_picture(Rgb8Image(5, 4, kRed), 9, 7);
  EXPECT_EQ(sheet.width, 9);
  EXPECT_EQ(sheet.at(4, 3)[0], kRed[0]);
  EXPECT_NE(sheet.at(5, 3)[0], kRed[0]);
  EXPECT_THROW(pad_picture(Rgb8Image(5, 4, kRed), 4, 7), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
