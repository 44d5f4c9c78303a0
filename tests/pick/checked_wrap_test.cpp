// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

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

  /// Moves the landmarks of the mouth down to the chin, all alike, as a detection does that takes
  /// the crease of the chin for the mouth.
  void move_mouth(bool is_found_by_program) {
    for (WrapLandmark& landmark : landmarks_) {
      const bool is_mouth = landmark.name.starts_with("mouth") || landmark.name.starts_with("lip");
      landmark.is_found_by_program = is_found_by_program;
      if (is_mouth) landmark.scan_position.y() -= 17;
    }
    std::erase_if(landmarks_,
                  [](const WrapLandmark& landmark) { return landmark.name.starts_with("chin"); });
  }

  /// How far the lips of a wrapped head are from the lips of the scan.
  double lips_off(const WrapResult& result) const {
    return (row3(result.positions, here_.at("lip_lower")) - row3(there_, here_.at("lip_lower")))
        .norm();
  }

  ReliefCorrelation correlation(const WrapResult& result, const std::string& name) const {
    return std::ranges::find(result.features, name, &FeatureCheck::name)->correlation;
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
  EXPECT_GT(correlation(result, "mouth").correlation_at_feature, 0.75);
  EXPECT_TRUE(doubtful_part_warnings(shape_, result).empty());
}

TEST_F(CheckedWrap, PickedLandmarksStayAndTheWrongMouthIsNamed) {
  move_mouth(false);
  const WrapResult result = wrapped();
  EXPECT_GT(lips_off(result), 5);
  EXPECT_TRUE(result.dropped_landmarks.empty());
  EXPECT_TRUE(correlation(result, "mouth").is_doubtful());
  EXPECT_THAT(doubtful_part_warnings(shape_, result), Contains(HasSubstr("the mouth is doubtful")));
}

TEST_F(CheckedWrap, AMouthInItsPlaceIsNotDoubtfulBecauseItsShapeDiffers) {
  there_ = 10 * some_head(4);
  scan_.positions = shape_.skin.rows_of(there_);
  for (WrapLandmark& landmark : landmarks_) landmark.scan_position = row3(there_, landmark.vertex);
  const WrapResult result = wrapped();
  EXPECT_LT(lips_off(result), 4) << "in its place";
  const ReliefCorrelation mouth = correlation(result, "mouth");
  EXPECT_FALSE(mouth.is_high()) << "the test needs shapes that differ";
  EXPECT_GT(mouth.correlation_at_feature, mouth.best_correlation_nearby + 0.1);
  EXPECT_TRUE(doubtful_part_warnings(shape_, result).empty());
}

}  // namespace
}  // namespace crowdface::testing
