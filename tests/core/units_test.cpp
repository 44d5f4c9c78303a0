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

TEST(Axis, NamesReadBack) {
  for (const char* name : {"+X", "-X", "+Y", "-Y", "+Z", "-Z"}) {
    EXPECT_EQ(name_of(*parse_axis(name)), name);
  }
  EXPECT_EQ(parse_axis("y"), (Axis{1, 1}));
  for (const char* bad : {"", "+", "W", "+XY", "++X"}) EXPECT_EQ(parse_axis(bad), std::nullopt);
}

}  // namespace
}  // namespace crowdface
