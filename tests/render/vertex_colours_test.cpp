// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/vertex_colours.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(RegionColours, AVertexOfOneRegionHasItsColour) {
  const VertexColours colours = region_colours(Eigen::MatrixXd::Identity(4, 4));
  for (Eigen::Index k = 0; k < 4; ++k) {
    EXPECT_TRUE(colours.row(k).transpose().isApprox(palette_colour(k)));
    for (Eigen::Index other = 0; other < k; ++other) {
      EXPECT_GT((palette_colour(k) - palette_colour(other)).norm(), 0.2F);
    }
  }
}

TEST(RegionColours, MixturesStayDisplayable) {
  const Eigen::MatrixXd alpha = Eigen::MatrixXd::Constant(1, 9, 1.0 / 9);
  const VertexColours colours = region_colours(alpha);
  EXPECT_GE(colours.minCoeff(), 0);
  EXPECT_LE(colours.maxCoeff(), 1);
}

TEST(MaskColours, GoFromClayToTheRegionsColour) {
  const Eigen::Vector3f colour(1, 0, 0);
  const VertexColours colours = mask_colours(Eigen::Vector3d(0, 0.5, 1), colour);
  EXPECT_TRUE(colours.row(2).transpose().isApprox(colour));
  EXPECT_TRUE(colours.row(1).isApprox((colours.row(0) + colours.row(2)) / 2));
  EXPECT_GT(colours(0, 2), 0.5F);
}

}  // namespace
}  // namespace crowdface
