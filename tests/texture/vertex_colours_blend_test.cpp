// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/vertex_colours_blend.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

ColourRows tone(int value) {
  return ColourRows::Constant(3, 3, static_cast<std::uint8_t>(value));
}

// Pigments add up: half of a light tone and half of a dark one reflect the geometric mean of their light.
TEST(VertexColoursBlend, IsAMeanOfDensities) {
  const std::vector<ColourRows> heads = {tone(204), tone(51), ColourRows(0, 3)};
  const ColourRows half = blend_vertex_colours(heads, {{0.5, 0.5, 0}, {1, 0, 0}}, {});
  EXPECT_NEAR(half(0, 0), 0.41 * 255, 2);  // the mean of light is 0.60
  EXPECT_EQ(half, blend_vertex_colours(heads, {{0.25, 0.25, 0.5}, {1, 0, 0}}, {}))
      << "a head without colours lends nothing";
  EXPECT_EQ(blend_vertex_colours(heads, {{0, 1, 0}, {1, 0, 0}}, {}), tone(51))
      << "one head's are its own";
}

TEST(VertexColoursBlend, LeavesPartsTheirTargets) {
  const std::vector<ColourRows> heads = {tone(204), tone(51)};
  const ColourRows blended = blend_vertex_colours(heads, {{0, 1}, {1, 0}}, {false, true, false});
  EXPECT_EQ(blended(0, 0), 51);
  EXPECT_EQ(blended(1, 0), 204);
}

}  // namespace
}  // namespace crowdface
