// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/depth_map.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(DepthMap, WithoutSurfaceAgreesWithNoFace) {
  DepthMap map(Positions(0, 3), {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()}, 2);
  map.smooth();
  EXPECT_EQ(map.fit(0, 0, 1).correlation, -1);
}

}  // namespace
}  // namespace crowdface
