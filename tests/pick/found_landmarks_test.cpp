// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/found_landmarks.h"

#include <algorithm>

#include <Eigen/Geometry>
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

/// The scan is the template itself, whose edges are 5 mm long. Earlier, each landmark of a scan was
/// moved to the nearest vertex; then landmarks lay up to 6 mm from the template's.
TEST(FoundLandmarks, AreNotRoundedToTheVerticesOfTheScan) {
  const SyntheticHeads heads(5000, SyntheticHeads::Parts::kEyesAndTeeth);
  Similarity place = some_place();
  place.rotation = Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, 1).normalized());
  for (std::uint64_t h = 0; h < 12; ++h) {
    const WrapTemplate shape =
        make_template(heads.topology(), 10 * heads.positions(1 + h / 4, h % 4), {});
    const Scan scan{place.apply(shape.positions), triangles_of(heads.topology())};
    const std::vector<WrapLandmark> found =
        find_landmarks(shape, propose_landmarks(shape), scan,
                       {.up = place.rotation * Eigen::Vector3d::UnitY(),
                        .front = place.rotation * Eigen::Vector3d::UnitZ()});
    EXPECT_GE(found.size(), 12U);
    for (const WrapLandmark& landmark : found) {
      // The front of the chin is flat, so its foremost point may lie anywhere on it.
      if (landmark.name == "chin") continue;
      const Eigen::Vector3d off = row3(scan.positions, landmark.vertex) - landmark.scan_position;
      EXPECT_LT(off.norm() / place.scale, 4.5) << landmark.name << " of head " << h;
    }
  }
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
