// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/units.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(Length, CarriesItsUnit) {
  EXPECT_EQ(parse_length_mm("8 mm"), 8.0);
  EXPECT_EQ(parse_length_mm("1.5cm"), 15.0);
  EXPECT_EQ(parse_length_mm("0.24 m"), 240.0);
  for (const char* bad : {"8", "mm", "8 km", "8 mm mm", "nan mm", "", "8mm "}) {
    EXPECT_EQ(parse_length_mm(bad), std::nullopt) << bad;
  }
}

TEST(LengthUnit, MayBeAnyLength) {
  EXPECT_EQ(parse_length_unit("cm"), LengthUnit::kCentimetre);
  EXPECT_EQ(parse_length_unit("243.84 cm"), LengthUnit{2438.4});
  EXPECT_EQ(parse_length_unit("10 mm"), LengthUnit::kCentimetre);
  for (const char* text : {"ft", "foot", "feet", "1 ft", "12 in"}) {
    const auto unit = parse_length_unit(text);
    ASSERT_TRUE(unit) << text;
    EXPECT_NEAR(mm_per(*unit), 304.8, 1e-9) << text;
  }
  EXPECT_EQ(name_of(*parse_length_unit("feet")), "ft");
  for (const char* bad : {"yards", "0 mm", "-1 cm", "1e30 m", ""}) {
    EXPECT_EQ(parse_length_unit(bad), std::nullopt) << bad;
  }
  for (const char* text : {"mm", "in", "ft", "243.84 cm", "0.3 mm"}) {
    const LengthUnit unit = *parse_length_unit(text);
    EXPECT_EQ(parse_length_unit(name_of(unit)), unit) << text;
  }
  EXPECT_EQ(fitting_unit(0.0267, 65), LengthUnit{2438.4}) << "Poser";
  EXPECT_EQ(fitting_unit(0.0286, 65), LengthUnit{2438.4});
  EXPECT_EQ(fitting_unit(0.0327, 65), LengthUnit{2000});
  EXPECT_EQ(nearest_unit(27, 280, kMetricUnits), LengthUnit::kCentimetre);
  EXPECT_EQ(nearest_unit(0.9, 280, kLengthUnits), LengthUnit::kFoot);
  EXPECT_EQ(nearest_unit(11, 280, kLengthUnits), LengthUnit::kInch);
  EXPECT_EQ(nearest_unit(4.5, 65, kLengthUnits), LengthUnit::kCentimetre) << "a child's face";
}

TEST(Axis, NamesReadBack) {
  for (const char* name : {"+X", "-X", "+Y", "-Y", "+Z", "-Z"}) {
    EXPECT_EQ(name_of(*parse_axis(name)), name);
  }
  EXPECT_EQ(parse_axis("y"), (Axis{1, 1}));
  for (const char* bad : {"", "+", "W", "+XY", "++X"}) EXPECT_EQ(parse_axis(bad), std::nullopt);
}

}  // namespace
}  // namespace crowdface
