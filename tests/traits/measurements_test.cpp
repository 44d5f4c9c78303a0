// SPDX-License-Identifier: Apache-2.0
#include "crowdface/traits/measurements.h"

#include <fstream>
#include <set>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace crowdface::testing {
namespace {

std::size_t landmark(const std::string& name) {
  const auto& all = trait_landmarks();
  for (std::size_t l = 0; l < all.size(); ++l) {
    if (all[l].name == name) return l;
  }
  ADD_FAILURE() << name;
  return 0;
}

/// A face whose landmarks have simple coordinates: x to its left, y up, z to the front.
Positions simple_face() {
  Positions points = Positions::Zero(static_cast<Index>(trait_landmarks().size()), 3);
  const auto put = [&](const std::string& name, double x, double y, double z) {
    points.row(static_cast<Index>(landmark(name))) << x, y, z;
  };
  put("nose_bridge", 0, 0, 0);
  put("nose_tip", 0, -40, 30);
  put("nose_base", 0, -40, 0);
  put("nose_wing_left", 18, -40, 5);
  put("nose_wing_right", -18, -40, 5);
  put("eye_inner_left", 16, 0, -5);
  put("eye_inner_right", -16, 0, -5);
  put("eye_outer_left", 46, 3, -5);
  put("eye_outer_right", -46, -3, -5);
  return points;
}

double value_of(const std::string& name, const Positions& points) {
  return measure(measurements()[*find_measurement(name)], points);
}

TEST(Measurements, HaveNamesAndLandmarksOfTheirOwn) {
  std::set<std::string_view> names;
  for (const Measurement& of : measurements()) {
    EXPECT_TRUE(names.insert(of.name).second) << of.name;
    EXPECT_FALSE(of.symbol.empty() || of.definition.empty()) << of.name;
    EXPECT_FALSE(landmarks_of(of).empty()) << of.name;
  }
  std::set<std::string> landmarks;
  for (const TraitLandmark& of : trait_landmarks()) {
    EXPECT_TRUE(landmarks.insert(of.name).second) << of.name;
  }
}

TEST(Measurements, OfASimpleFaceAreWhatACalliperShows) {
  const Positions face = simple_face();
  EXPECT_DOUBLE_EQ(value_of("nose_height", face), 40);
  EXPECT_DOUBLE_EQ(value_of("nose_length", face), 50);
  EXPECT_DOUBLE_EQ(value_of("nose_width", face), 36);
  EXPECT_DOUBLE_EQ(value_of("nasal_index", face), 0.9);
  EXPECT_DOUBLE_EQ(value_of("intercanthal", face), 32);
  EXPECT_NEAR(value_of("eye_width", face), std::sqrt(30. * 30 + 3 * 3), 1e-12);
  EXPECT_NEAR(value_of("nasal_tip_angle", face), std::atan2(40, 30) * 180 / M_PI, 1e-6);
}

/// The left eye rises by 3 mm and the right eye falls by 3 mm: on average they are level.
TEST(Measurements, TheSlopeOfTheEyesIsTheMeanOfBothSides) {
  Positions face = simple_face();
  EXPECT_NEAR(value_of("eye_slope", face), 0, 1e-9);
  face(static_cast<Index>(landmark("eye_outer_right")), 1) = 3;
  EXPECT_NEAR(value_of("eye_slope", face), std::atan2(3, 30) * 180 / M_PI, 1e-6);
}

TEST(Measurements, DoNotDependOnThePoseOfTheHead) {
  const Positions face = simple_face();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Positions moved = (face * turn.transpose()).rowwise() + Eigen::RowVector3d(9, -70, 800);
  for (const char* name : {"nose_width", "nasal_tip_angle", "eye_slope", "nasal_index"}) {
    EXPECT_NEAR(value_of(name, moved), value_of(name, face), 2e-6) << name;
  }
}

TEST(Measurements, AreAllInTheDocumentation) {
  std::ifstream file(CROWDFACE_SOURCE_DIR "/docs/traits.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const Measurement& of : measurements()) {
    const std::string row = "| `" + std::string(of.name) + "` | " + std::string(of.symbol) + " |";
    const std::size_t at = page.find(row);
    ASSERT_NE(at, std::string::npos) << row;
    const std::string line = page.substr(at, page.find('\n', at) - at);
    EXPECT_TRUE(line.ends_with("| " + std::string(of.definition) + " |")) << line;
  }
  for (const TraitLandmark& of : trait_landmarks()) {
    EXPECT_NE(page.find("`" + of.name + "`"), std::string::npos) << of.name;
    EXPECT_NE(page.find(" | " + std::string(of.location) + " |"), std::string::npos) << of.name;
  }
}

}  // namespace
}  // namespace crowdface::testing
