// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/expression_check.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/paint/face_marks.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {
namespace {

HeadSet synthetic_heads(std::uint64_t seed, std::uint64_t count, Index vertices = 5000) {
  const SyntheticHeads made(vertices);
  HeadSet faces{made.topology(), made.uvs(), {}};
  for (std::uint64_t h = 0; h < count; ++h) {
    faces.heads.push_back({concat("head_", h), made.positions(seed, h)});
  }
  return faces;
}

std::string warnings_of(const HeadSet& head_set) {
  return join(odd_expression_warnings(head_set, mean_head_shape(head_set).is_skin, HeadAxes()),
              "\n");
}

/// The displacement of a point of the average head in an expression, in centimetres.
/// \param across  distance from the symmetry plane
/// \param side    1 left, −1 right
using Expression = Eigen::Vector3d (*)(double across, double height, int side,
                                       const FaceMarks& marks);

/// Lets the jaw drop by 2 cm.
Eigen::Vector3d open_mouth(double /*across*/, double height, int /*side*/, const FaceMarks& marks) {
  return {0, height < marks.mouth_height ? -2.0 : 0.0, 0};
}
/// Moves the corners of the mouth by 8 mm up and outwards, and the cheeks with them.
Eigen::Vector3d smile(double across, double height, int side, const FaceMarks& marks) {
  const double x = across - 2.5, y = height - marks.mouth_height;
  return 0.8 * std::exp(-(x * x + y * y) / 2) * Eigen::Vector3d(side, 1, 0);
}
/// Moves the upper lids down by up to 9 mm.
Eigen::Vector3d close_lids(double across, double height, int /*side*/, const FaceMarks& marks) {
  const double x = across - 3.2, y = height - marks.eyes_height - 0.4;
  return {0, -0.9 * std::exp(-(x * x + 4 * y * y) / 1.5), 0};
}
/// Moves the brows up by up to 11 mm, the inner ends most.
Eigen::Vector3d raise_brows(double across, double height, int /*side*/, const FaceMarks& marks) {
  const double x = across - 1.5, y = height - marks.eyes_height - 2;
  return {0, 1.1 * std::exp(-(x * x / 3 + y * y / 1.2)), 0};
}

/// Adds an expression to one head.
void make_face(HeadSet& heads, std::size_t head, Expression expression) {
  const HeadShape mean = mean_head_shape(heads);
  const auto marks = find_face_marks(heads.topology, mean, HeadAxes());
  ASSERT_TRUE(marks);
  for (Index v = 0; v < mean.positions.rows(); ++v) {
    if (mean.positions(v, 2) < 3) continue;
    const double aside = mean.positions(v, 0) - marks->symmetry_offset;
    heads.heads[head].positions.row(v) +=
        expression(std::abs(aside), mean.positions(v, 1), aside < 0 ? -1 : 1, *marks).transpose();
  }
}

TEST(ExpressionCheck, TellsOneHeadThatGrimacesAmongNeutralOnes) {
  const std::vector<std::pair<Expression, std::string>> expressions = {
      {open_mouth, "its mouth is open"},
      {smile, "the corners of its mouth are higher"},
      {close_lids, "its upper lids are lower"},
      {raise_brows, "its brows are raised"}};
  for (const std::uint64_t seed : {3, 4, 5, 8, 9, 10}) {
    const HeadSet neutral = synthetic_heads(seed, 8);
    EXPECT_EQ(warnings_of(neutral), "") << "seed " << seed;
    for (const auto& [expression, words] : expressions) {
      HeadSet heads = neutral;
      make_face(heads, 5, expression);
      const std::string warnings = warnings_of(heads);
      EXPECT_THAT(warnings, ::testing::AllOf(::testing::StartsWith("head_5: " + words),
                                             ::testing::HasSubstr("is its expression neutral?"),
                                             ::testing::Not(::testing::HasSubstr("\n"))))
          << "seed " << seed;
    }
  }
}

TEST(ExpressionCheck, ComparesNothingWithFewerThanFourHeads) {
  HeadSet heads = synthetic_heads(2, 3);
  make_face(heads, 1, open_mouth);
  EXPECT_EQ(warnings_of(heads), "");
}

TEST(ExpressionCheck, IgnoresTheNoiseOfDenseScans) {
  HeadSet heads = synthetic_heads(2, 5, 150'000);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.02);
  for (const std::size_t h : {std::size_t{1}, std::size_t{3}}) {
    for (double& x : heads.heads[h].positions.reshaped()) x += noise(random);
  }
  EXPECT_EQ(warnings_of(heads), "");
  make_face(heads, 3, smile);
  EXPECT_THAT(warnings_of(heads), ::testing::StartsWith("head_3: the corners of its mouth"));
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
  for (const fs::path& file : list_files(folder / "ict16", extension_filter(".obj"))) {
    all.heads.push_back({file.stem().string(), read_obj(file).positions});
  }
  EXPECT_EQ(warnings_of(all), "");
  const auto six_from = [&](std::size_t first) {
    HeadSet six{all.topology, all.uvs, {}};
    for (std::size_t i = 0; i < 6; ++i) six.heads.push_back(all.heads[(first + 3 * i) % 16]);
    return six;
  };
  for (std::size_t first = 0; first < 16; first += 2) EXPECT_EQ(warnings_of(six_from(first)), "");
  const auto told = [&](const std::vector<std::string>& shapes, const std::string& words,
                        double strength = 1) {
    Positions moves = Positions::Zero(neutral.positions.rows(), 3);
    for (const std::string& shape : shapes) {
      moves += read_obj(folder / "ict_shapes" / (shape + ".obj")).positions - neutral.positions;
    }
    int count = 0;
    for (std::size_t first = 0; first < 16; first += 2) {
      HeadSet six = six_from(first);
      six.heads[2].positions += strength * moves;
      const std::string warnings = warnings_of(six);
      if (warnings.starts_with(six.heads[2].name + ": " + words)) ++count;
    }
    return count;
  };
  const std::string corners = "the corners of its mouth are higher",
                    lids = "its upper lids are lower";
  EXPECT_EQ(told({"jawOpen"}, "its mouth is open", 0.6), 8);
  EXPECT_EQ(told({"mouthSmile_L", "mouthSmile_R"}, corners), 8);
  EXPECT_GE(told({"mouthSmile_L", "mouthSmile_R"}, corners, 0.6), 6);
  EXPECT_GE(told({"mouthPucker"}, "its mouth is pursed"), 5);
  EXPECT_GE(told({"cheekPuff_L", "cheekPuff_R"}, "its cheeks are puffed"), 4);
  EXPECT_EQ(told({"eyeBlink_L", "eyeBlink_R"}, lids), 8);
  EXPECT_GE(told({"eyeBlink_L", "eyeBlink_R"}, lids, 0.6), 5);
  EXPECT_EQ(told({"eyeBlink_L"}, lids), 8);
  EXPECT_GE(told({"browInnerUp_L", "browInnerUp_R"}, "its brows are raised"), 7);
}

}  // namespace
}  // namespace crowdface
