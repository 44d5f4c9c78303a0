// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/found_landmarks.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/mesh/vector3.h"
#include "crowdface/pick/proposed_landmarks.h"

#include "pick/some_template.h"

namespace crowdface::testing {
namespace {

/// A head of another topology than the template's, in metres, lying on its side somewhere.
class FoundLandmarksTest : public ::testing::Test {
 protected:
  FoundLandmarksTest() {
    const SyntheticHeads heads(12000, SyntheticHeads::Parts::kEyesAndTeeth);
    scan_ = {truth_.apply(10 * heads.positions(1, 1)), triangles_of(heads.topology())};
  }
  PoseHint standing() const {
    return {.up = truth_.rotation * Eigen::Vector3d::UnitY(),
            .front = truth_.rotation * Eigen::Vector3d::UnitZ()};
  }

  Similarity truth_ = some_place();
  Scan scan_;
  WrapTemplate shape_ = some_template();
  std::map<std::string, std::uint32_t> here_ = propose_landmarks(shape_);
};

TEST_F(FoundLandmarksTest, LieWhereTheTemplatesOwnVerticesWouldOnThatHead) {
  const std::vector<WrapLandmark> found = find_landmarks(shape_, here_, scan_, standing());
  ASSERT_GE(found.size(), 12U);
  const Positions same_head = truth_.apply(10 * some_head(1));
  std::vector<double> off;
  for (const WrapLandmark& landmark : found) {
    off.push_back(1000 * (row3(same_head, landmark.vertex) - landmark.scan_position).norm());
    EXPECT_LT(off.back(), 9) << landmark.name;
  }
  std::ranges::sort(off);
  EXPECT_LT(off[off.size() / 2], 4);
}

TEST_F(FoundLandmarksTest, AScanWithoutAFaceHasNone) {
  const WrapTemplate& ball = shape_;
  Positions round = ball.positions;
  for (Index v = 0; v < round.rows(); ++v) {
    round.row(v) = 100 * (row3(round, v) + Eigen::Vector3d(0, 1e-3, 0)).normalized().transpose();
  }
  const Scan scan{round, triangles_of(ball.topology)};
  EXPECT_TRUE(
      find_landmarks(shape_, here_, scan, {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()})
          .empty());
}

}  // namespace
}  // namespace crowdface::testing
