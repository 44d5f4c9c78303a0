// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/camera.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"

#include "render/project.h"
#include "render/shapes.h"

namespace crowdface {
namespace {

constexpr View kViews[] = {View::kFront, View::kThreeQuarter, View::kProfile, View::kBack};

/// Two boxes of points, unlike in size and place.
std::vector<Positions> two_heads() {
  std::vector<Positions> heads(2, Positions(8, 3));
  for (int i = 0; i < 8; ++i) {
    const Eigen::RowVector3d corner(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    heads[0].row(i) = 10 * corner + Eigen::RowVector3d(-3, 100, 2);
    heads[1].row(i) =
        corner.cwiseProduct(Eigen::RowVector3d(4, 19, 6)) + Eigen::RowVector3d(-2, 95, 5);
  }
  return heads;
}

std::vector<const Positions*> pointers(const std::vector<Positions>& heads) {
  std::vector<const Positions*> out;
  out.reserve(heads.size());
  for (const Positions& head : heads) out.push_back(&head);
  return out;
}

TEST(Camera, EveryHeadFitsWithItsMarginAndTouchesIt) {
  const auto heads = two_heads();
  const FramingOptions options = {.margin = 0.08};
  for (const View view : kViews) {
    const Camera camera = fit_camera(pointers(heads), {}, view, options);
    double low = 1;
    double high = 0;
    for (const Positions& head : heads) {
      for (Index i = 0; i < head.rows(); ++i) {
        const Eigen::Vector2d place = testing::project(camera, head.row(i));
        low = std::min(low, place.minCoeff());
        high = std::max(high, place.maxCoeff());
      }
    }
    EXPECT_NEAR(low, 0.08, 1e-9);
    EXPECT_NEAR(high, 0.92, 1e-9);
  }
}

// Masks of faces, and busts that end at the throat, lost their chins. A mask's nose lies as low as a bust's chin.
TEST(Camera, NeverCutsAChin) {
  const auto lowest_shown = [](double front_of_lowest, double height_of_nose) {
    Positions head(9, 3);
    head << -2, 0, front_of_lowest, 2, 0, front_of_lowest, 0, 1, front_of_lowest,  //
        -5, 5, 8.5, 5, 5, 8.5, 0, height_of_nose, 10, -7, 12, 0, 7, 12, 0, 0, 20, 6;
    const Positions* heads[] = {&head};
    const Camera camera = fit_camera(heads, {}, View::kFront, {.bottom_cut_fraction = 0.22});
    return testing::project(camera, head.row(0).transpose()).y();
  };
  for (const double nose : {7.0, 9.0}) {
    EXPECT_LE(lowest_shown(8, nose), 0.94 + 1e-9) << "a mask, its nose at " << nose;
    EXPECT_GT(lowest_shown(3, nose), 0.94 + 1e-9) << "a neck, the nose at " << nose;
  }
}

TEST(Camera, ShowsWhatIsBesideTheHeadsUnlessItIsTooLow) {
  const auto heads = two_heads();
  FramingOptions options = {.margin = 0.08, .bottom_cut_fraction = 0.2};
  const Camera alone = fit_camera(pointers(heads), {}, View::kFront, options);
  options.extra_points = {{0, 50, 5}};
  EXPECT_EQ(fit_camera(pointers(heads), {}, View::kFront, options).distance, alone.distance);
  const Eigen::Vector3d hair(2, 122, 6);
  options.extra_points.push_back(hair);
  const Camera both = fit_camera(pointers(heads), {}, View::kFront, options);
  EXPECT_GT(both.distance, alone.distance);
  const Eigen::Vector2d place = testing::project(both, hair.transpose());
  EXPECT_NEAR(std::min(place.minCoeff(), 1 - place.maxCoeff()), 0.08, 1e-9);
}

TEST(Camera, ViewsShareTheDistanceOfTheFurthest) {
  const auto heads = two_heads();
  const auto cameras = fit_cameras(pointers(heads), {}, kViews);
  double furthest = 0;
  for (const View view : kViews) {
    furthest = std::max(furthest, fit_camera(pointers(heads), {}, view).distance);
  }
  ASSERT_EQ(cameras.size(), 4U);
  for (const Camera& camera : cameras) EXPECT_EQ(camera.distance, furthest);
}

TEST(Camera, StandsWhereTheFaceLooks) {
  const auto heads = two_heads();
  const Camera front = fit_camera(pointers(heads), {}, View::kFront);
  EXPECT_EQ(front.back, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(front.right, Eigen::Vector3d::UnitX());
  const Camera profile = fit_camera(pointers(heads), {}, View::kProfile);
  EXPECT_TRUE(profile.back.isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  const Camera back = fit_camera(pointers(heads), {}, View::kBack);
  EXPECT_TRUE(back.back.isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
  // What lies in front of the face appears on the left.
  EXPECT_LT(testing::project(profile, profile.target + Eigen::Vector3d::UnitZ()).x(), 0.5);
}

// Shoulders reach further back than the head, which stood left of the middle.
TEST(Camera, PutsTheHeadInTheMiddleNotTheBust) {
  const Positions head = make_sphere(1).positions;
  const Positions shoulders = (0.8 * head).rowwise() + Eigen::RowVector3d(0, -1.9, -1);
  Positions bust(head.rows() + shoulders.rows(), 3);
  bust << head, shoulders;
  const Positions* heads[] = {&bust};
  for (const View view : {View::kFront, View::kThreeQuarter, View::kProfile, View::kBack}) {
    const Camera camera = fit_camera(heads, {}, view);
    EXPECT_NEAR(testing::project(camera, Eigen::RowVector3d::Zero()).x(), 0.5, 0.005);
    for (Index i = 0; i < bust.rows(); ++i) {
      const Eigen::Vector2d place = testing::project(camera, bust.row(i));
      EXPECT_GE(place.minCoeff(), 0.06 - 1e-9);
      EXPECT_LE(place.maxCoeff(), 0.94 + 1e-9);
    }
  }
}

TEST(Camera, FollowsTheAxesOfTheConfig) {
  const auto heads = two_heads();
  std::vector<Positions> turned = heads;  // x, y, z → y, z, x: up is +Z, front is +X
  for (Positions& head : turned) {
    const Positions copy = head;
    head.col(0) = copy.col(2);
    head.col(1) = copy.col(0);
    head.col(2) = copy.col(1);
  }
  for (const View view : kViews) {
    const Camera a = fit_camera(pointers(heads), {}, view);
    const Camera b = fit_camera(pointers(turned), {{2, 1}, {0, 1}}, view);
    EXPECT_NEAR(a.distance, b.distance, 1e-9);
    EXPECT_TRUE(
        testing::project(a, heads[0].row(3)).isApprox(testing::project(b, turned[0].row(3)), 1e-9));
  }
}

TEST(Camera, ScalesWithTheUnit) {
  const Mesh sphere = make_sphere(1);
  const Mesh large = make_sphere(1000);
  const Positions* small_head[] = {&sphere.positions};
  const Positions* large_head[] = {&large.positions};
  const Camera a = fit_camera(small_head, {}, View::kThreeQuarter);
  const Camera b = fit_camera(large_head, {}, View::kThreeQuarter);
  EXPECT_NEAR(b.distance, 1000 * a.distance, 1e-6);
}

TEST(Camera, CutBelowGivesUpTheLowestPartOnly) {
  Positions head(10, 3);  // a neck up to 4, a chin at 5, a nose at 9, ears, a skull
  head << -2, 0, 3, 2, 0, 3, 0, 4, 3, 0, 5, 8.5, -5, 6, 5, 5, 6, 5, 0, 9, 10, -7, 12, 0, 7, 12, 0,
      0, 20, 6;
  const Positions* heads[] = {&head};
  const Camera camera = fit_camera(heads, {}, View::kFront, {.bottom_cut_fraction = 0.22});
  EXPECT_LT(camera.distance, fit_camera(heads, {}, View::kFront).distance);
  for (Index i = 3; i < head.rows(); ++i) {
    const Eigen::Vector2d place = testing::project(camera, head.row(i));
    EXPECT_GE(place.minCoeff(), 0.06 - 1e-9);
    EXPECT_LE(place.maxCoeff(), 0.94 + 1e-9);
  }
}

// Images cut the necks of long heads, although the heads had no shoulders that could be cut off.
TEST(Camera, ShouldersAreWiderThanTheHead) {
  Positions head(8, 3);  // the rim of a neck, ears, a skull
  head << -5, 0, 0, 5, 0, 0, -6, 10, 0, 6, 10, 0, -7, 15, 0, 7, 15, 0, 0, 20, 0, 0, 10, 9;
  EXPECT_FALSE(has_shoulders(head, {}, 0.22));
  head.row(0).x() = -8;
  head.row(1).x() = 8;
  EXPECT_TRUE(has_shoulders(head, {}, 0.22));
}

TEST(Camera, OneSinglePointIsNoTrouble) {
  const Positions point = Positions::Constant(1, 3, 4);
  const Positions* heads[] = {&point};
  const Camera camera = fit_camera(heads, {}, View::kFront);
  EXPECT_GT(camera.distance, 0);
  EXPECT_TRUE(testing::project(camera, point.row(0)).isApprox(Eigen::Vector2d(0.5, 0.5)));
}

TEST(Camera, RefusesWhatItCannotSee) {
  EXPECT_THROW(fit_camera({}, {}, View::kFront), BrokenPrecondition);
  Positions point = Positions::Zero(1, 3);
  const Positions* heads[] = {&point};
  EXPECT_THROW(fit_camera(heads, {{1, 1}, {1, -1}}, View::kFront), BrokenPrecondition);
  point(0, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(fit_camera(heads, {}, View::kFront), InvalidInput);
}

}  // namespace
}  // namespace crowdface
