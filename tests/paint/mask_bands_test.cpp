// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/mask_bands.h"

#include <gtest/gtest.h>

#include "crowdface/io/image.h"
#include "crowdface/paint/proposed_masks.h"

#include "paint/synth_heads.h"
#include "support/expect_error.h"

namespace crowdface::testing {
namespace {

const std::vector<MaskBand> kThree = {MaskBand::kBrow, MaskBand::kNose, MaskBand::kMouth};
const std::vector<MaskBand> kFive = {MaskBand::kBrow, MaskBand::kNose, MaskBand::kMouth,
                                     MaskBand::kEars, MaskBand::kNeck};

TEST(Bands, RunSoftlyIntoOneAnotherAndSumToOne) {
  const Eigen::VectorXd heights = Eigen::VectorXd::LinSpaced(401, -10, 10);
  const auto alpha = horizontal_bands(heights, 3, -3);
  EXPECT_LT((alpha.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  EXPECT_GE(alpha.minCoeff(), 0);
  EXPECT_EQ(alpha(0, 2), 1);
  EXPECT_EQ(alpha(220, 1), 1);
  EXPECT_EQ(alpha(400, 0), 1);
  EXPECT_LT((alpha.bottomRows(400) - alpha.topRows(400)).cwiseAbs().maxCoeff(), 0.06);
  expect_error(ExitCode::kBadData, {"eyes above the mouth"},
               [&] { horizontal_bands(heights, 3, 3); });
}

TEST(Bands, ComeNearTheMaskThatSyntheticHeadsBring) {
  const HeadSet faces = synth_heads(5000);
  const HeadShape head = mean_head_shape(faces);
  const auto marks = find_face_marks(faces.topology, head, {});
  ASSERT_TRUE(marks);
  const auto alpha = propose_bands(faces.topology, head, *marks, kThree);
  Image image{512, 512, 3, -1, synthetic_region_mask(512)};
  const auto theirs =
      region_weights(faces.topology, faces.uvs, {MaskSource("mask", image)}, 3).alpha;
  EXPECT_LT((alpha - theirs).cwiseAbs().mean(), 0.045);
}

/// Five bands of synthetic heads.
class FiveBands : public ::testing::Test {
 protected:
  HeadSet faces_ = synth_heads(20000);
  HeadShape head_ = mean_head_shape(faces_);
  FaceMarks marks_ = find_face_marks(faces_.topology, head_, {}).value();
  RegionWeights::Alpha alpha_ = propose_bands(faces_.topology, head_, marks_, kFive);
};

TEST_F(FiveBands, EarsLieAtTheSidesAndTheNeckBelowTheChin) {
  EXPECT_LT((alpha_.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  EXPECT_GE(alpha_.minCoeff(), 0);
  for (Index v = 0; v < alpha_.rows(); ++v) {
    const double x = head_.positions(v, 0), y = head_.positions(v, 1);
    if (std::abs(x) < 3) {
      EXPECT_LT(alpha_(v, 3), 0.02) << "no ear so near the middle";
    }
    if (y > marks_.tip_height) {
      EXPECT_LT(alpha_(v, 4), 0.05) << "no neck beside the nose";
    }
    if (y < marks_.chin_height - 4.5) {
      EXPECT_EQ(alpha_(v, 4), 1);
    }
  }
  Index left = 0, right = 0;
  for (Index v = 0; v < alpha_.rows(); ++v) {
    if (alpha_(v, 3) > 0.9) ++(head_.positions(v, 0) < 0 ? left : right);
  }
  EXPECT_GT(left, 100);
  EXPECT_GT(right, 100);
}

// The transitions around ears and neck were 16 mm wide, and blended faces had ridges above the
// ears.
TEST_F(FiveBands, AllTransitionsAreWide) {
  const double face = marks_.eye_to_mouth();
  double steepest = 0;
  for (Index f = 0; f < faces_.topology.face_count(); ++f) {
    const auto corners = faces_.topology.face(f);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const std::uint32_t a = corners[c], b = corners[(c + 1) % corners.size()];
      const double length = (head_.positions.row(a) - head_.positions.row(b)).norm();
      const double change = (alpha_.row(a) - alpha_.row(b)).cwiseAbs().maxCoeff();
      if (length > 0) steepest = std::max(steepest, change / length * face);
    }
  }
  // A transition of 0.6 distances from eyes to mouth has a slope of 1.5 / 0.6 in its middle.
  EXPECT_LT(steepest, 4);
}

TEST(Bands, AHeadWithoutEarsOrNeckHasNoSuchBands) {
  const HeadSet faces = synth_heads(5000);
  HeadShape head = mean_head_shape(faces);
  const auto marks = find_face_marks(faces.topology, head, {});
  ASSERT_TRUE(marks);
  for (Index v = 0; v < head.positions.rows(); ++v) {
    head.positions(v, 0) = std::clamp(head.positions(v, 0), -5.0, 5.0);
    head.positions(v, 1) = std::max(head.positions(v, 1), marks->chin_height);
  }
  for (const auto& [band, phrase] :
       {std::pair{MaskBand::kEars, "ears"}, {MaskBand::kNeck, "neck"}}) {
    const std::vector<MaskBand> bands = {MaskBand::kBrow, MaskBand::kNose, MaskBand::kMouth, band};
    expect_error(ExitCode::kBadData, {phrase},
                 [&] { propose_bands(faces.topology, head, *marks, bands); });
  }
}

TEST(Bands, NamesAreReadInTheirOrder) {
  EXPECT_EQ(
      parse_bands("mouth,brow,nose,neck"),
      (std::vector<MaskBand>{MaskBand::kMouth, MaskBand::kBrow, MaskBand::kNose, MaskBand::kNeck}));
  EXPECT_EQ(names_of(kFive), (std::vector<std::string>{"brow", "nose", "mouth", "ears", "neck"}));
  for (const char* wrong :
       {"brow", "", "brow,nose,mouth,", "brow,nose,mouth,chin", "brow,nose,nose,mouth"}) {
    expect_error(ExitCode::kUsage, {"--bands"}, [&] { parse_bands(wrong); });
  }
}

TEST(Bands, HeadsThatCannotBePaintedAreRefusedWithTheWayOut) {
  HeadSet faces = synth_heads(5000);
  const HeadShape head = mean_head_shape(faces);
  expect_error(ExitCode::kBadData, {"along +X", "look along +Z with +Y up"}, [&] {
    propose_masks(faces, head, {{1, 1}, {0, 1}}, kThree, 64);
  });
  faces.topology.corner_uvs.clear();
  expect_error(ExitCode::kBadData, {"no texture coordinates", "without regions"}, [&] {
    propose_masks(faces, head, {{1, 1}, {2, 1}}, kThree, 64);
  });
}

}  // namespace
}  // namespace crowdface::testing
