// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/suggested_places.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/mesh/vector3.h"
#include "crowdface/pick/proposed_landmarks.h"
#include "crowdface/wrap/scan_surface.h"

#include "pick/some_template.h"

namespace crowdface::testing {
namespace {

std::vector<Triangle> skin_of(const WrapTemplate& shape) {
  std::vector<Triangle> triangles = shape.skin.triangles;
  for (Triangle& t : triangles) {
    for (std::uint32_t& v : t) v = shape.skin.vertices[v];
  }
  return triangles;
}

std::vector<Triangle> eyes_of(const WrapTemplate& shape) {
  std::vector<Triangle> triangles;
  for (const Triangle& t : occluding_triangles(shape)) {
    if (shape.parts.classes[shape.components.component_of_vertex[t[0]]] == PartClass::kRigid) {
      triangles.push_back(t);
    }
  }
  return triangles;
}

/// A scan of another head in the template's topology: turned, in metres, elsewhere.
class SuggestedPlacesTest : public ::testing::Test {
 protected:
  PickedLandmark pair(const std::string& name) const {
    const std::uint32_t v = proposals_.at(name);
    return {name, v, row3(scan_.positions(), v), std::nullopt};
  }
  std::vector<PickedLandmark> pairs(const std::vector<std::string>& names) const {
    std::vector<PickedLandmark> landmarks;
    for (const std::string& name : names) landmarks.push_back(pair(name));
    return landmarks;
  }
  double mm_off(const PickedPlace& place, std::uint32_t vertex) const {
    return (place.point - row3(scan_.positions(), vertex)).norm() / truth_.scale;
  }

  Similarity truth_ = some_place();
  WrapTemplate shape_ = some_template();
  PickableMesh template_{shape_.positions, skin_of(shape_), eyes_of(shape_)};
  PickableMesh scan_{truth_.apply(10 * some_head(1)), skin_of(shape_)};
  MirrorPlane plane_ = symmetry_plane(shape_, shape_.positions);
  std::map<std::string, std::uint32_t> proposals_ = propose_landmarks(shape_);
};

TEST_F(SuggestedPlacesTest, TheTemplatesShapeTellsItsMiddleAndItsEyes) {
  const auto at = [&](const std::string& name) {
    return row3(shape_.positions, proposals_.at(name));
  };
  for (const char* name :
       {"nose_tip", "nose_base", "nose_bridge", "lip_upper", "lip_lower", "chin"}) {
    EXPECT_NEAR(at(name).x(), 0, 4) << name;
  }
  for (const auto& [above, below] : {std::pair("nose_bridge", "nose_tip"),
                                     {"nose_tip", "nose_base"},
                                     {"nose_base", "lip_upper"},
                                     {"lip_upper", "lip_lower"},
                                     {"lip_lower", "chin"},
                                     {"lid_upper_left", "lid_lower_left"}}) {
    EXPECT_GT(at(above).y(), at(below).y()) << above;
  }
  EXPECT_GT(at("eye_outer_left").x(), at("eye_inner_left").x() + 15);
  EXPECT_LT(at("eye_outer_right").x(), at("eye_inner_right").x() - 15);
  EXPECT_GT(at("eye_inner_left").x(), 5);
  // Nothing of the face lies before the tip of the nose.
  double foremost = -1e300;
  for (const std::uint32_t v : shape_.skin.vertices) {
    foremost = std::max(foremost, shape_.positions(v, 2));
  }
  EXPECT_NEAR(at("nose_tip").z(), foremost, 1);
}

TEST_F(SuggestedPlacesTest, TheTemplatesSkinFallsIntoRegions) {
  const SkinRegions regions = face_regions(shape_);
  ASSERT_EQ(regions.region_of_vertex.size(), shape_.skin.vertices.size());
  const auto region_at = [&](std::uint32_t vertex) {
    const auto& rows = shape_.skin.vertices;
    const auto at = std::lower_bound(rows.begin(), rows.end(), vertex);
    return regions.names[regions.region_of_vertex[static_cast<std::size_t>(at - rows.begin())]];
  };
  EXPECT_EQ(region_at(proposals_.at("nose_tip")), "nose");
  EXPECT_EQ(region_at(proposals_.at("chin")), "mouth");
  Index top = 0;
  shape_.skin.rows_of(shape_.positions).col(1).maxCoeff(&top);
  EXPECT_EQ(region_at(shape_.skin.vertices[static_cast<std::size_t>(top)]), "brow");
}

TEST_F(SuggestedPlacesTest, TheOtherHalfIsSuggestedOnTheTemplate) {
  const PickedLandmark left = {"mole_left", proposals_.at("eye_inner_left"), std::nullopt, {}};
  const auto places = suggest_places({left}, template_, scan_, plane_, {});
  ASSERT_EQ(places.template_places.size(), 1U);
  const Eigen::Vector3d expected = plane_.mirrored(row3(shape_.positions, *left.template_vertex));
  EXPECT_LT((places.template_places.at("mole_right").point - expected).norm(), 5);
  EXPECT_TRUE(places.scan_places.empty());
  EXPECT_FALSE(places.pose);
}

TEST_F(SuggestedPlacesTest, ThreePairsTellTheOthersOnTheScan) {
  const std::vector<std::string> names = {"eye_outer_left", "eye_outer_right", "chin"};
  EXPECT_TRUE(suggest_places(pairs({names[0], names[1]}), template_, scan_, plane_, proposals_)
                  .scan_places.empty());
  const auto places = suggest_places(pairs(names), template_, scan_, plane_, proposals_);
  ASSERT_TRUE(places.pose);
  EXPECT_LT((places.pose->pose.rotation - truth_.rotation).norm(), 0.15);
  EXPECT_NEAR(places.pose->pose.scale / truth_.scale, 1, 0.15);
  for (const char* name : {"nose_tip", "eye_inner_left", "lip_upper"}) {
    ASSERT_TRUE(places.scan_places.contains(name)) << name;
    EXPECT_LT(mm_off(places.scan_places.at(name), proposals_.at(name)), 15) << name;
  }
  for (const std::string& name : names) {
    EXPECT_FALSE(places.scan_places.contains(name)) << name;
    EXPECT_FALSE(places.template_places.contains(name)) << name;
  }
}

TEST_F(SuggestedPlacesTest, PairsInALineTellNothing) {
  std::vector<PickedLandmark> line;
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t v = proposals_.at("nose_tip");
    line.push_back({std::string(1, static_cast<char>('a' + i)), v,
                    Eigen::Vector3d(row3(scan_.positions(), v) + Eigen::Vector3d(0.01 * i, 0, 0)),
                    std::nullopt});
  }
  EXPECT_FALSE(fit_pose_to_picked(line, template_.positions()));
}

TEST_F(SuggestedPlacesTest, AMisplacedPairIsToldAndLeftOut) {
  auto landmarks = pairs({"eye_outer_left", "eye_outer_right", "nose_tip", "chin", "eye_inner_left",
                          "eye_inner_right", "lip_upper"});
  const auto good = fit_pose_to_picked(landmarks, template_.positions());
  for (const auto& [name, residual] : good->residuals) EXPECT_FALSE(residual.is_outlier) << name;
  landmarks[3].scan_point = *landmarks[3].scan_point + Eigen::Vector3d(0.06, 0, 0);
  const auto bad = fit_pose_to_picked(landmarks, template_.positions());
  for (const auto& [name, residual] : bad->residuals)
    EXPECT_EQ(residual.is_outlier, name == "chin");
  EXPECT_GT(bad->residuals.at("chin").distance_mm, 45);
  std::erase_if(landmarks, [](const PickedLandmark& one) { return one.name == "chin"; });
  const auto without = fit_pose_to_picked(landmarks, template_.positions());
  EXPECT_LT((bad->pose.translation - without->pose.translation).norm(), 1e-12);
}

}  // namespace
}  // namespace crowdface::testing
