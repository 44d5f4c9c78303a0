// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/pick/landmark_file.h"
#include "crowdface/pick/landmark_names.h"

#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

TEST(LandmarkText, ReadsBackAsTheSame) {
  const std::vector<PickedLandmark> landmarks = {
      {"chin", 966, Eigen::Vector3d(12.5, -61, 100.30000000000001), std::nullopt},
      {"nose_tip", 4857, std::nullopt, std::nullopt},
      {"scar: é \"#1\" # no comment", std::nullopt, Eigen::Vector3d(-1e-7, 0, 1e8), std::nullopt},
      {"12", 0, Eigen::Vector3d(1, 2, 3), 20817},
      {"true", 7, Eigen::Vector3d(0, 0, 0), std::nullopt},
      {"empty", std::nullopt, std::nullopt, std::nullopt}};
  const TemporaryFolder folder;
  const LandmarkFile file =
      read_landmarks(folder.write("l.yaml", format_landmarks(landmarks, "# ours\n")));
  EXPECT_EQ(file.template_places.size(), 4U);
  EXPECT_EQ(file.scan_places.size(), 4U);
  for (const PickedLandmark& landmark : landmarks) {
    if (landmark.template_vertex) {
      ASSERT_TRUE(file.template_places.contains(landmark.name)) << landmark.name;
      EXPECT_TRUE(file.template_places.at(landmark.name).is_vertex);
      EXPECT_EQ(file.template_places.at(landmark.name).vertex, *landmark.template_vertex);
    }
    if (!landmark.scan_point) continue;
    ASSERT_TRUE(file.scan_places.contains(landmark.name)) << landmark.name;
    const LandmarkFile::Place& place = file.scan_places.at(landmark.name);
    EXPECT_EQ(place.is_vertex, landmark.scan_vertex.has_value());
    if (place.is_vertex) {
      EXPECT_EQ(place.vertex, *landmark.scan_vertex);
    } else {
      EXPECT_EQ(place.point, *landmark.scan_point);
    }
  }
}

TEST(LandmarkText, OfNothingReadsBackAsNothing) {
  const TemporaryFolder folder;
  const LandmarkFile file = read_landmarks(folder.write("l.yaml", format_landmarks({})));
  EXPECT_TRUE(file.template_places.empty());
  EXPECT_TRUE(file.scan_places.empty());
}

TEST(LandmarkText, FirstCommentsAreTold) {
  EXPECT_EQ(header_comments("# a\n\n  # b\ntemplate: {} # c\n"), "# a\n\n  # b\n");
  EXPECT_EQ(header_comments("template: {}\n# c\n"), "");
  EXPECT_EQ(header_comments(""), "");
  EXPECT_EQ(header_comments("# without an end"), "");
  EXPECT_FALSE(has_comments_after_header("# a\ntemplate: {a: 1}\n"));
  EXPECT_TRUE(has_comments_after_header("# a\ntemplate: {a: 1} # b\n"));
  EXPECT_TRUE(has_comments_after_header("template: {a: 1}\n# b\n"));
}

TEST(LandmarkNames, SidesAreMirrored) {
  EXPECT_EQ(mirrored_name("eye_outer_left"), "eye_outer_right");
  EXPECT_EQ(mirrored_name("brow_r"), "brow_l");
  EXPECT_EQ(mirrored_name("Ear.L"), "Ear.R");
  EXPECT_EQ(mirrored_name("left"), "right");
  for (const char* name : {"chin", "upper", "bright", "cleft", "l_brow", ""}) {
    EXPECT_FALSE(mirrored_name(name)) << name;
  }
  std::size_t sided = 0;
  for (const LandmarkDefinition& known : suggested_landmarks()) {
    const auto other = mirrored_name(known.name);
    if (!other) continue;
    ++sided;
    EXPECT_EQ(mirrored_name(*other), known.name);
    EXPECT_TRUE(std::any_of(suggested_landmarks().begin(), suggested_landmarks().end(),
                            [&](const LandmarkDefinition& one) { return one.name == *other; }))
        << *other;
  }
  EXPECT_EQ(sided, 28U);
}

}  // namespace
}  // namespace crowdface::testing
