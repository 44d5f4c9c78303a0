// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_colours.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

ColourRows rows(std::initializer_list<std::initializer_list<int>> values) {
  ColourRows result(static_cast<Eigen::Index>(values.size()), 3);
  Eigen::Index i = 0;
  for (const auto& row : values) {
    for (const int value : row) result.data()[i++] = static_cast<std::uint8_t>(value);
  }
  return result;
}

TEST(ObjColours, AreSharesOrBytes) {
  EXPECT_EQ(obj_colours("v 1 2 3 1 0.2 0\nvt 0 0\n v 1 2 3 0 0 0.4\r\n", 2),
            rows({{255, 51, 0}, {0, 0, 102}}));
  EXPECT_EQ(obj_colours("v 1 2 3 255 51 1\n", 1), rows({{255, 51, 1}}));
  EXPECT_EQ(obj_colours("v 1 2 3 1.001 0.2 0\n", 1), rows({{255, 51, 0}})) << "not quite 1";
  EXPECT_EQ(obj_colours("v 1 2 3\n", 1).rows(), 0);
  EXPECT_EQ(obj_colours("v 1 2 3\nv 1 2 3 0 0.2 1\nv 1 2 3 0 0 1\nv 1 2 3 1\n", 4),
            rows({{255, 255, 255}, {0, 51, 255}, {0, 0, 255}, {255, 255, 255}}))
      << "vertices of objects without colours are white";
  EXPECT_EQ(obj_colours("v 1 2 3 1 1 1\nv 1 2 3\nv 1 2 3\n", 3).rows(), 0);
  EXPECT_EQ(obj_colours("v 1 2 3 1 1 nan\n", 1).rows(), 0);
}

TEST(ObjColours, AreWrittenBehindCoordinates) {
  const ColourRows colours = rows({{255, 51, 0}, {0, 0, 102}});
  const std::string text = with_colours("# a\nv 1 2 3\nv 4 5 6 0 0 0\nf 1 2 1\n", colours);
  EXPECT_EQ(text, "# a\nv 1 2 3 1.0000 0.2000 0.0000\nv 4 5 6 0.0000 0.0000 0.4000\nf 1 2 1\n");
  EXPECT_EQ(obj_colours(text, 2), colours);
}

TEST(ObjColours, OfZBrushAreRead) {
  const std::string text = "v 1 2 3\nv 4 5 6\n#MRGB ffff3300\n#MRGB ff000066\nf 1 2 1\n";
  const auto painted = move_polypaint_to_vertices(text);
  ASSERT_TRUE(painted);
  EXPECT_EQ(obj_colours(*painted, 2), rows({{255, 51, 0}, {0, 0, 102}}));
  EXPECT_EQ(painted->find("#MRGB"), std::string::npos);
  EXPECT_EQ(move_polypaint_to_vertices("v 1 2 3\nv 4 5 6\n#MRGB ffff3300\n"), std::nullopt);
  EXPECT_EQ(move_polypaint_to_vertices("v 1 2 3\n#MRGB ffxx3300\n"), std::nullopt);
  EXPECT_EQ(move_polypaint_to_vertices("v 1 2 3\n"), std::nullopt);
}

TEST(ObjColours, OfZBrushBelongToTheirSubtool) {
  const std::string plain = "v 1 2 3\nf 1 1 1\n", red = "v 1 2 3\nv 4 5 6\n#MRGB ffff0000",
                    blue = "ff0000ff\nf 1 2 1\n";
  const auto colours = [](const std::string& text, Eigen::Index vertices) {
    return obj_colours(move_polypaint_to_vertices(text).value_or(""), vertices);
  };
  EXPECT_EQ(colours(plain + red + blue, 3), rows({{255, 255, 255}, {255, 0, 0}, {0, 0, 255}}));
  EXPECT_EQ(colours(red + blue + plain, 3), rows({{255, 0, 0}, {0, 0, 255}, {255, 255, 255}}));
  EXPECT_EQ(colours(red + blue + plain + red + blue, 5).row(4), rows({{0, 0, 255}}).row(0));
  EXPECT_EQ(move_polypaint_to_vertices(plain + plain + plain + red + blue), std::nullopt)
      << "most vertices have no colour";
  EXPECT_EQ(move_polypaint_to_vertices(plain + red + "\nf 1 2 1\n"), std::nullopt)
      << "one colour for two vertices";
}

}  // namespace
}  // namespace crowdface
