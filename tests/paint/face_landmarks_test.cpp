// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/face_landmarks.h"

#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/traits/measurements.h"

#include "paint/synth_heads.h"

namespace crowdface::testing {
namespace {

FaceLandmarks landmarks_of_mean(const HeadSet& heads) {
  const Adjacency adjacency = build_adjacency(heads.topology);
  const Components components = find_components(adjacency);
  const Positions mean = mean_head(heads);
  return find_face_landmarks(heads.topology, components,
                             find_parts(heads.topology, adjacency, components, mean), mean, {});
}

/// Landmarks in millimetres, in the order of trait_landmarks().
Positions in_order(const FaceLandmarks& found) {
  Positions points = Positions::Zero(static_cast<Index>(trait_landmarks().size()), 3);
  for (std::size_t l = 0; l < trait_landmarks().size(); ++l) {
    const auto place = found.points.find(trait_landmarks()[l].name);
    if (place == found.points.end()) continue;
    points.row(static_cast<Index>(l)) = 10 * place->second.position.transpose();
  }
  return points;
}

TEST(FaceLandmarks, AreFoundOnSyntheticHeadsOfAnyResolution) {
  for (const Index vertices : {5000, 20000}) {
    const FaceLandmarks found = landmarks_of_mean(synth_heads(vertices, 8));
    for (const TraitLandmark& landmark : trait_landmarks()) {
      if (landmark.name == "hairline") continue;
      EXPECT_TRUE(found.points.contains(landmark.name)) << landmark.name << " at " << vertices;
    }
    EXPECT_TRUE(found.missing_reasons.contains("hairline")) << "no shape shows it";
    EXPECT_EQ(found.points.size() + found.missing_reasons.size(), trait_landmarks().size());
  }
}

/// The ranges of adults, with room for heads that were sculpted rather than measured.
TEST(FaceLandmarks, GivePlausibleMeasurements) {
  const Positions points = in_order(landmarks_of_mean(synth_heads(20000, 8)));
  const std::map<std::string, std::pair<double, double>> ranges = {
      {"face_height", {105, 135}},   {"face_width", {120, 155}},   {"nose_height", {45, 62}},
      {"nose_width", {28, 42}},      {"mouth_width", {42, 58}},    {"intercanthal", {28, 40}},
      {"biocular", {80, 98}},        {"eye_width", {25, 34}},      {"ear_height", {48, 70}},
      {"head_length", {175, 215}},   {"head_breadth", {135, 170}}, {"upper_lip_height", {14, 26}},
      {"nasal_tip_angle", {75, 120}}};
  for (const auto& [name, range] : ranges) {
    const double value = measure(measurements()[*find_measurement(name)], points);
    EXPECT_GT(value, range.first) << name;
    EXPECT_LT(value, range.second) << name;
  }
}

TEST(FaceLandmarks, LeftAndRightAreSymmetric) {
  const FaceLandmarks found = landmarks_of_mean(synth_heads(20000, 8));
  for (const auto& [name, left] : found.points) {
    const std::size_t side = name.find("_left");
    if (side == std::string::npos) continue;
    const auto right = found.points.find(name.substr(0, side) + "_right");
    ASSERT_NE(right, found.points.end()) << name;
    EXPECT_GT(left.position.x(), 0) << name << ": the head's own left";
    const Eigen::Vector3d image = right->second.position.cwiseProduct(Eigen::Vector3d(-1, 1, 1));
    EXPECT_LT((left.position - image).norm(), 0.15) << name << ", centimetres";
  }
}

/// A head whose nose, mouth and chin lie aside, as on people whose faces are not symmetric.
TEST(FaceLandmarks, OfNoseAndMouthFollowAnAsymmetricFace) {
  constexpr double kAside = 0.4, kHalfWidth = 4;  // in centimetres
  HeadSet heads = synth_heads(20000, 8);
  const FaceLandmarks before = landmarks_of_mean(heads);
  for (Head& head : heads.heads) {
    for (Index v = 0; v < head.positions.rows(); ++v) {
      const double x = head.positions(v, 0) / kHalfWidth;
      if (head.positions(v, 2) > 0) head.positions(v, 0) += kAside * std::exp(-x * x / 2);
    }
  }
  const FaceLandmarks after = landmarks_of_mean(heads);
  for (const char* name : {"nose_tip", "nose_base", "lip_upper", "mouth_middle", "lip_lower"}) {
    EXPECT_NEAR(after.points.at(name).position.x() - before.points.at(name).position.x(), kAside,
                0.1)
        << name;
  }
}

TEST(FaceLandmarks, WithoutAFaceThereAreNone) {
  const HeadSet heads = synth_heads(5000, 2);
  HeadSet flat = heads;
  for (Head& head : flat.heads) head.positions.col(2) *= 0.01;
  EXPECT_TRUE(landmarks_of_mean(flat).points.empty());
}

}  // namespace
}  // namespace crowdface::testing
