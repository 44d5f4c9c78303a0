// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "crowdface/parts/anchors.h"

namespace crowdface {
namespace {

/// Two teeth 2 apart, gums between and beside them, along a line.
struct TwoTeeth {
  Positions positions = Positions::Zero(7, 3);
  std::vector<std::uint32_t> first = {0}, second = {1}, bound = {2, 3, 4, 5, 6};
  TwoTeeth() { positions.col(0) << 0, 2, 0, 1, 2, -0.9, -3; }
  PartWeights part_weights() const { return {positions, {first, second}, bound, 1.5}; }
};

RigidMotion shift(double y) {
  RigidMotion motion;
  motion.moved_pivot = {0, y, 0};
  return motion;
}

TEST(PartWeights, CarryWhatIsAtAPartAndLeaveWhatIsFar) {
  const TwoTeeth scene;
  Positions result = scene.positions;
  const std::vector<RigidMotion> motions = {shift(1), shift(-1)};
  scene.part_weights().move_with_parts(scene.positions, motions, result);
  EXPECT_NEAR(result(2, 1), 1, 1e-12) << "at the first tooth";
  EXPECT_NEAR(result(4, 1), -1, 1e-12) << "at the second";
  EXPECT_NEAR(result(3, 1), 0, 1e-12) << "half way between both";
  EXPECT_GT(result(5, 1), 0.2);
  EXPECT_LT(result(5, 1), 0.8);
  EXPECT_EQ(result(6, 1), 0);
}

TEST(PartWeights, LeaveEverythingToTheBitWhereNothingMoved) {
  const TwoTeeth scene;
  Positions head = scene.positions;
  head.array() += 0.1;
  Positions result = head;
  scene.part_weights().move_with_parts(head, std::vector<RigidMotion>(2), result);
  EXPECT_TRUE(result == head);
}

}  // namespace
}  // namespace crowdface
