// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/mesh/vector3.h"
#include "crowdface/pick/proposed_landmarks.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/wrap.h"

#include "pick/some_template.h"

namespace crowdface::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// A scan of a head that the template is not, and the landmarks that lie on it.
class CheckedWrap : public ::testing::Test {
 protected:
  CheckedWrap() {
    for (const auto& [name, vertex] : here_) {
      landmarks_.push_back({name, vertex, row3(there_, vertex), true});
    }
  }

  /// Moves the landmarks of the mouth, all alike. By default down to the chin, as a detection does
  /// that takes the crease of the chin for the mouth.
  void move_mouth(bool is_found_by_program, double up_mm = -17) {
    for (WrapLandmark& landmark : landmarks_) {
      const bool is_mouth = landmark.name.starts_with("mouth") || landmark.name.starts_with("lip");
      landmark.is_found_by_program = is_found_by_program;
      if (is_mouth) landmark.scan_position.y() += up_mm;
    }
    std::erase_if(landmarks_,
                  [](const WrapLandmark& landmark) { return landmark.name.starts_with("chin"); });
  }

  /// Where a landmark of the template lies on the scan after the wrap.
  Eigen::Vector3d on_scan(const WrapResult& result, const std::string& name) const {
    return apply_similarity(result.pose, row3(result.positions, here_.at(name)));
  }

  /// How far the lips of a wrapped head are from the lips of the scan.
  double lips_off(const WrapResult& result) const {
    return (on_scan(result, "lip_lower") - row3(there_, here_.at("lip_lower"))).norm();
  }

  /// How far the lips of the scan are above the lips of a wrapped head.
  double lips_above(const WrapResult& result) const {
    double sum = 0;
    for (const char* name : {"lip_upper", "lip_lower"})
      sum += there_(here_.at(name), 1) - on_scan(result, name).y();
    return sum / 2;
  }

  /// How much farther the lips of a head are apart than the template's, in mm.
  double lips_apart(const Positions& head) const {
    double sum = 0;
    const FaceFeature& mouth = *std::ranges::find(features_, "mouth", &FaceFeature::name);
    for (const auto& [upper, lower] : mouth.lip_line) {
      for (const auto& [positions, sign] : {std::pair(&head, 1), {&shape_.positions, -1}}) {
        sum += sign * (point_on(*positions, upper.corners, upper.barycentric).y() -
                       point_on(*positions, lower.corners, lower.barycentric).y());
      }
    }
    return sum / static_cast<double>(mouth.lip_line.size());
  }

  static FeatureCheck mouth_of(const WrapResult& result) {
    return *std::ranges::find(result.features, "mouth", &FeatureCheck::name);
  }

  /// Makes another synthetic head the scan, with exact landmarks.
  void use_scan(std::uint64_t index) {
    there_ = 10 * some_head(index);
    scan_.positions = shape_.skin.rows_of(there_);
    for (WrapLandmark& landmark : landmarks_)
      landmark.scan_position = row3(there_, landmark.vertex);
  }

  WrapResult wrapped() const {
    return wrap_checked(shape_, nullptr, features_, scan_, landmarks_,
                        PoseHint{Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()});
  }

  WrapTemplate shape_ = some_template();
  Positions there_ = 10 * some_head(1);
  Scan scan_{shape_.skin.rows_of(there_), shape_.skin.triangles};
  std::map<std::string, std::uint32_t> here_ = propose_landmarks(shape_);
  std::vector<FaceFeature> features_ = face_features(shape_, here_);
  std::vector<WrapLandmark> landmarks_;
};

TEST_F(CheckedWrap, RightLandmarksGiveFeaturesThatAgree) {
  const WrapResult result = wrapped();
  ASSERT_GE(features_.size(), 4U);
  for (const FeatureCheck& feature : result.features) {
    EXPECT_GT(feature.correlation.correlation_at_feature, 0.75) << feature.name;
  }
  EXPECT_TRUE(doubtful_part_warnings(shape_, result).empty());
  EXPECT_TRUE(result.dropped_landmarks.empty());
}

TEST_F(CheckedWrap, FoundLandmarksThatPutTheMouthOnTheChinAreDropped) {
  move_mouth(true);
  const WrapResult trusted = wrap(shape_, nullptr, scan_, landmarks_, std::nullopt);
  EXPECT_GT(lips_off(trusted), 5) << "the landmarks mislead the wrap";
  const WrapResult result = wrapped();
  EXPECT_LT(lips_off(result), lips_off(trusted) - 1);
  EXPECT_THAT(result.dropped_landmarks, Contains("lip_lower"));
  EXPECT_GT(mouth_of(result).correlation.correlation_at_feature, 0.75);
  EXPECT_TRUE(doubtful_part_warnings(shape_, result).empty());
}

TEST_F(CheckedWrap, PickedLandmarksStayAndTheWrongMouthIsNamed) {
  move_mouth(false);
  const WrapResult result = wrapped();
  EXPECT_GT(lips_off(result), 5);
  EXPECT_TRUE(result.dropped_landmarks.empty());
  EXPECT_TRUE(mouth_of(result).is_doubtful());
  EXPECT_THAT(doubtful_part_warnings(shape_, result), Contains(HasSubstr("the mouth is doubtful")));
}

TEST_F(CheckedWrap, ExactLandmarksOfAMouthStayAlthoughItsShapeDiffers) {
  use_scan(4);
  const WrapResult result = wrapped();
  EXPECT_FALSE(mouth_of(result).correlation.is_high()) << "the test needs shapes that differ";
  EXPECT_TRUE(result.dropped_landmarks.empty());
  EXPECT_LT(lips_off(result), 2);
  EXPECT_TRUE(doubtful_part_warnings(shape_, result).empty());
}

TEST_F(CheckedWrap, TheLineBetweenTheLipsTellsHowFarTheMouthIsOff) {
  for (const std::uint64_t head : {1, 2, 3, 4}) {
    for (const double moved : {-17.0, 0.0, 8.0}) {
      SCOPED_TRACE(::testing::Message() << "head " << head << ", moved by " << moved);
      use_scan(head);
      if (moved != 0) move_mouth(false, moved);
      const WrapResult result = wrapped();
      ASSERT_TRUE(mouth_of(result).scan_lip_line);
      EXPECT_NEAR(mouth_of(result).scan_lip_line->offset_mm, lips_above(result), 2.5);
      if (moved == 0) EXPECT_FALSE(mouth_of(result).is_doubtful());
      if (moved == -17) EXPECT_TRUE(mouth_of(result).is_doubtful());
    }
  }
}

// Statues' lips, which nothing parts, came out as open mouths.
TEST_F(CheckedWrap, ClosedLipsStayClosedWhateverPullsThemApart) {
  const FaceFeature& mouth = *std::ranges::find(features_, "mouth", &FaceFeature::name);
  for (const auto& points : mouth.lip_line) {
    for (const std::size_t side : {0, 1}) {
      const std::uint32_t v = points[side].corners[0];
      const double up_mm = side == 0 ? 5 : -5;
      landmarks_.push_back({"lip", v, row3(there_, v) + up_mm * Eigen::Vector3d::UnitY(), false});
    }
  }
  const WrapResult pulled = wrap(shape_, nullptr, scan_, landmarks_, std::nullopt);
  EXPECT_GT(lips_apart(pulled.positions), 2) << "the landmarks pull the lips apart";
  const WrapResult result = wrapped();
  EXPECT_LT(std::abs(lips_apart(result.positions)), 0.5);
  EXPECT_TRUE(result.dropped_landmarks.empty());
}

TEST_F(CheckedWrap, LipsThatAreApartOnTheScanStayApart) {
  // How much a vertex belongs to the lower lip: 1 at the lower lip, 0 at the upper, smooth between.
  std::map<std::uint32_t, double> known;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const FaceFeature& mouth = *std::ranges::find(features_, "mouth", &FaceFeature::name);
  for (const auto& [upper, lower] : mouth.lip_line) {
    for (const std::uint32_t v : upper.corners) known[v] = 0;
    for (const std::uint32_t v : lower.corners) known[v] = 1;
    middle += row3(there_, lower.corners[0]) / static_cast<double>(mouth.lip_line.size());
  }
  Eigen::VectorXd share = Eigen::VectorXd::Constant(there_.rows(), 0.5);
  for (int step = 0; step < 200; ++step) {
    const Eigen::VectorXd before = share;
    for (const std::uint32_t v : shape_.skin.vertices) {
      const auto neighbours = shape_.adjacency.items_of(v);
      double sum = 0;
      for (const std::uint32_t other : neighbours) sum += before(other);
      share(v) = known.contains(v) ? known[v] : sum / static_cast<double>(neighbours.size());
    }
  }
  for (const std::uint32_t v : shape_.skin.vertices) {
    const double distance = (row3(there_, v) - middle).norm();
    there_(v, 1) -= 3 * share(v) * std::exp(-distance * distance / (40 * 40));
  }
  scan_.positions = shape_.skin.rows_of(there_);
  for (WrapLandmark& landmark : landmarks_) landmark.scan_position = row3(there_, landmark.vertex);
  const WrapResult result = wrapped();
  EXPECT_GT(lips_apart(result.positions), 2);
}

}  // namespace
}  // namespace crowdface::testing
