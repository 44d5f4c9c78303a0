// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/expression_check.h"

#include <cmath>
#include <filesystem>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/paint/face_marks.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {
namespace {

HeadSet synthetic_heads(std::uint64_t count, Index vertices = 5000) {
  const SyntheticHeads made(vertices);
  HeadSet faces{made.topology(), made.uvs(), {}};
  for (std::uint64_t h = 0; h < count; ++h) {
    faces.heads.push_back({concat("head_", h), made.positions(2, h)});
  }
  return faces;
}

std::string warnings_of(const HeadSet& head_set) {
  return join(odd_expression_warnings(head_set, mean_head_shape(head_set).is_skin, HeadAxes(), 10));
}

/// Lets the jaw drop by 2 cm.
void open_mouth(const FaceMarks& marks, Positions& head) {
  for (Index v = 0; v < head.rows(); ++v) {
    if (head(v, 2) > 3 && head(v, 1) < marks.mouth_height) head(v, 1) -= 2;
  }
}

/// Moves the corners of the mouth by 8 mm up and outwards, and the cheeks with them.
void smile(const FaceMarks& marks, Positions& head) {
  for (Index v = 0; v < head.rows(); ++v) {
    if (head(v, 2) < 3) continue;
    const double side = head(v, 0) < marks.symmetry_offset ? -1 : 1;
    const double x = side * (head(v, 0) - marks.symmetry_offset) - 2.5,
                 y = head(v, 1) - marks.mouth_height;
    const double share = std::exp(-(x * x + y * y) / 2);
    head(v, 0) += 0.8 * side * share;
    head(v, 1) += 0.8 * share;
  }
}

/// Moves the upper lids down by up to 9 mm.
void close_lids(const FaceMarks& marks, Positions& head) {
  for (Index v = 0; v < head.rows(); ++v) {
    if (head(v, 2) < 3) continue;
    const double x = std::abs(head(v, 0) - marks.symmetry_offset) - 3.2,
                 y = head(v, 1) - marks.eyes_height - 0.4;
    head(v, 1) -= 0.9 * std::exp(-(x * x + 4 * y * y) / 1.5);
  }
}

TEST(ExpressionCheck, TellsOneHeadThatGrimacesAmongNeutralOnes) {
  const HeadSet neutral = synthetic_heads(8);
  EXPECT_EQ(warnings_of(neutral), "");
  const auto marks = find_face_marks(neutral.topology, mean_head_shape(neutral), HeadAxes());
  ASSERT_TRUE(marks);
  const auto warnings = [&](const auto& grimace) {
    HeadSet heads = neutral;
    grimace(*marks, heads.heads[5].positions);
    return warnings_of(heads);
  };
  for (const auto& grimace : {open_mouth, smile}) {
    EXPECT_THAT(warnings(grimace),
                ::testing::AllOf(::testing::StartsWith("head_5: the skin around its mouth"),
                                 ::testing::HasSubstr("is its expression neutral?"),
                                 ::testing::Not(::testing::HasSubstr("lids"))));
  }
  EXPECT_THAT(warnings(close_lids),
              ::testing::AllOf(::testing::StartsWith("head_5: its lids"),
                               ::testing::Not(::testing::HasSubstr("mouth"))));
}

TEST(ExpressionCheck, ComparesNothingWithFewerThanFourHeads) {
  HeadSet heads = synthetic_heads(3);
  const auto marks = find_face_marks(heads.topology, mean_head_shape(heads), HeadAxes());
  ASSERT_TRUE(marks);
  open_mouth(*marks, heads.heads[1].positions);
  EXPECT_EQ(warnings_of(heads), "");
}

TEST(ExpressionCheck, IgnoresTheNoiseOfDenseScans) {
  HeadSet heads = synthetic_heads(5, 150'000);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.02);
  for (const std::size_t h : {std::size_t{1}, std::size_t{3}}) {
    for (double& x : heads.heads[h].positions.reshaped()) x += noise(random);
  }
  EXPECT_EQ(warnings_of(heads), "");
  const auto marks = find_face_marks(heads.topology, mean_head_shape(heads), HeadAxes());
  ASSERT_TRUE(marks);
  smile(*marks, heads.heads[3].positions);
  EXPECT_THAT(warnings_of(heads), ::testing::StartsWith("head_3: the skin around its mouth"));
}

/// Real heads, and expressions that were made for the average head: each is told if it is added to
/// one head of six.
TEST(ExpressionCheck, TellsExpressionsOfTheIctModel) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(CROWDFACE_SOURCE_DIR) / "../shared/faces";
  if (!fs::exists(folder / "ict_shapes")) {
    GTEST_SKIP() << "needs the ICT model's heads and shapes in ../shared/faces";
  }
  const ObjFile neutral = read_obj(folder / "ict_shapes/generic_neutral_mesh.obj");
  HeadSet all{neutral.topology, neutral.uvs, {}};
  for (const fs::path& file : list_files(folder / "ict16", has_extension(".obj"))) {
    all.heads.push_back({file.stem().string(), read_obj(file).positions});
  }
  EXPECT_EQ(warnings_of(all), "");
  const auto six_from = [&](std::size_t first) {
    HeadSet six{all.topology, all.uvs, {}};
    for (std::size_t i = 0; i < 6; ++i) six.heads.push_back(all.heads[(first + 3 * i) % 16]);
    return six;
  };
  for (std::size_t first = 0; first < 16; first += 2) EXPECT_EQ(warnings_of(six_from(first)), "");
  const auto told = [&](const std::vector<std::string>& shapes, const std::string& words) {
    Positions moves = Positions::Zero(neutral.positions.rows(), 3);
    for (const std::string& shape : shapes) {
      moves += read_obj(folder / "ict_shapes" / (shape + ".obj")).positions - neutral.positions;
    }
    int count = 0;
    for (std::size_t first = 0; first < 16; first += 2) {
      HeadSet six = six_from(first);
      six.heads[2].positions += moves;
      const std::string warnings = warnings_of(six);
      if (warnings.starts_with(six.heads[2].name + ": " + words)) ++count;
    }
    return count;
  };
  const std::string mouth = "the skin around its mouth", eyes = "its lids";
  EXPECT_EQ(told({"jawOpen"}, mouth), 8);
  EXPECT_GE(told({"mouthSmile_L", "mouthSmile_R"}, mouth), 6);
  EXPECT_GE(told({"mouthPucker"}, mouth), 6);
  EXPECT_GE(told({"eyeBlink_L", "eyeBlink_R"}, eyes), 6);
  EXPECT_GE(told({"eyeBlink_L"}, eyes), 5);
}

}  // namespace
}  // namespace crowdface
