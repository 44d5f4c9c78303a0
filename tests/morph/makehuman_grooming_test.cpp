// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/makehuman_grooming.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"

namespace crowdface::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAxisZ = -6;  // of the head, as in makehuman_grooming.cpp

/// A part of a cylinder about the head's axis, as a grid of quads: every degree from `first` to
/// last(height), every quarter of a centimetre in height.
template <class Last>
Mesh cylinder(double radius, int first, const Last& last, int lowest, int highest) {
  constexpr int kRowsPerCentimetre = 4;
  Mesh mesh;
  std::vector<Eigen::RowVector3d> places;
  std::vector<std::uint32_t> below;
  for (int row = lowest * kRowsPerCentimetre; row <= highest * kRowsPerCentimetre; ++row) {
    const double height = double{1} * row / kRowsPerCentimetre;
    std::vector<std::uint32_t> line;
    for (int degree = first; degree <= last(height); ++degree) {
      line.push_back(static_cast<std::uint32_t>(places.size()));
      places.push_back({radius * std::sin(degree * kDegree), height,
                        kAxisZ + radius * std::cos(degree * kDegree)});
      const std::size_t column = line.size() - 1;
      if (column > 0 && column < below.size()) {
        mesh.topology.add_face(std::vector<std::uint32_t>{below[column - 1], below[column],
                                                          line[column], line[column - 1]},
                               std::vector<std::uint32_t>{0, 0, 0, 0});
      }
    }
    below = line;
  }
  mesh.topology.vertex_count = static_cast<Index>(places.size());
  mesh.positions.resize(mesh.topology.vertex_count, 3);
  for (std::size_t v = 0; v < places.size(); ++v) {
    mesh.positions.row(static_cast<Index>(v)) = places[v];
  }
  mesh.uvs.setZero(1, 2);
  return mesh;
}

Mesh round_head() {
  return cylinder(
      8, -90, [](double) { return 90; }, -10, 10);
}

double degrees_of(const Positions& positions, Index v) {
  return std::atan2(positions(v, 0), positions(v, 2) - kAxisZ) / kDegree;
}

double radius_of(const Positions& positions, Index v) {
  return std::hypot(positions(v, 0), positions(v, 2) - kAxisZ);
}

TEST(MakeHumanGrooming, AFringeOverAnEyeEndsBesideTheEye) {
  // From the right temple it reaches 10 degrees beyond the nose at the height of the eyes, and it
  // covers the forehead up to the parting.
  const auto end = [](double height) { return std::min(10 + 6 * height, 44.0); };
  const Mesh hair = cylinder(9, -80, end, -2, 9);
  const Positions combed = combed_aside(hair.positions, round_head());
  double end_of_fringe = -90;
  for (Index v = 0; v < combed.rows(); ++v) {
    EXPECT_EQ(combed(v, 1), hair.positions(v, 1)) << "hair moves around the head";
    EXPECT_NEAR(radius_of(combed, v), 9, 0.01) << "the distance from the head stays";
    if (std::abs(combed(v, 1)) < 1) end_of_fringe = std::max(end_of_fringe, degrees_of(combed, v));
    if (combed(v, 1) > 7 || degrees_of(hair.positions, v) < -70) {
      EXPECT_EQ(combed.row(v), hair.positions.row(v)) << "above the parting and behind the temple";
    }
  }
  EXPECT_LT(end_of_fringe, -30) << "the eyes lie from -15 to -35 and from 15 to 35 degrees";
  EXPECT_GT(end_of_fringe, -60) << "it still frames the face";
}

TEST(MakeHumanGrooming, HairThatLeavesTheEyesFreeStays) {
  const Mesh hair = cylinder(
      9, -80, [](double height) { return height < 5 ? -50 : 44; }, -8, 9);
  EXPECT_EQ(combed_aside(hair.positions, round_head()), hair.positions);
}

TEST(MakeHumanGrooming, HairInsideTheHeadComesNoFurtherOut) {
  const auto end = [](double height) { return std::min(10 + 6 * height, 44.0); };
  const Mesh hair = cylinder(7.5, -80, end, -2, 9);
  const Positions combed = combed_aside(hair.positions, round_head());
  for (Index v = 0; v < combed.rows(); ++v) EXPECT_NEAR(radius_of(combed, v), 7.5, 0.01);
}

TEST(MakeHumanGrooming, SteepBrowsAreLevelledOnTheSkin) {
  constexpr double kSlope = 0.3, kGap = 0.1;
  Positions brows(22, 3);
  for (Index v = 0; v < brows.rows(); ++v) {
    const double side = v % 2 == 0 ? 1 : -1, x = 1 + 0.4 * static_cast<double>(v / 2);
    brows.row(v) << side * x, 1 + kSlope * (x - 1), kAxisZ + std::sqrt(64 - x * x) + kGap;
  }
  const Positions level = levelled_brows(brows, round_head());
  for (Index v = 0; v < brows.rows(); ++v) {
    const double x = level(v, 0);
    EXPECT_NEAR(level(v, 2), kAxisZ + std::sqrt(64 - x * x) + kGap, 0.01);
    EXPECT_NEAR(level(v, 0), -level(v ^ 1, 0), 1e-9) << "both sides alike";
  }
  const double slope = (level(20, 1) - level(0, 1)) / (level(20, 0) - level(0, 0));
  EXPECT_NEAR(std::atan(slope) / kDegree, 3, 1e-6);
  EXPECT_NEAR(level.col(1).mean(), brows.col(1).mean() + 0.15, 1e-9) << "brows move up";
}

TEST(MakeHumanGrooming, ACapClosesSlitsAndEndsBeforeTheHair) {
  const Mesh head = round_head();
  // Hair all round with a slit of two degrees in the middle.
  Mesh hair = cylinder(
      9, -60, [](double) { return -1; }, 0, 9);
  const Mesh left = cylinder(
      9, 1, [](double) { return 60; }, 0, 9);
  const auto first = static_cast<std::uint32_t>(hair.positions.rows());
  for (Index f = 0; f < left.topology.face_count(); ++f) {
    std::vector<std::uint32_t> corners(left.topology.face(f).begin(), left.topology.face(f).end());
    for (std::uint32_t& corner : corners) corner += first;
    hair.topology.add_face(corners, left.topology.face_uvs(f));
  }
  hair.positions.conservativeResize(first + left.positions.rows(), 3);
  hair.positions.bottomRows(left.positions.rows()) = left.positions;
  hair.topology.vertex_count = hair.positions.rows();

  const Mesh capped = with_cap(hair, head, head.topology.face_count(), {0.25, 0.75});
  const Index added = capped.positions.rows() - hair.positions.rows();
  ASSERT_GT(added, 0);
  EXPECT_EQ(capped.positions.topRows(hair.positions.rows()), hair.positions);
  bool in_slit = false;
  for (Index v = hair.positions.rows(); v < capped.positions.rows(); ++v) {
    EXPECT_NEAR(radius_of(capped.positions, v), 8.05, 0.01);
    EXPECT_LT(std::abs(degrees_of(capped.positions, v)), 60);
    EXPECT_GT(capped.positions(v, 1), 0);
    in_slit = in_slit || std::abs(degrees_of(capped.positions, v)) < 0.5;
  }
  EXPECT_TRUE(in_slit);
  const auto last = capped.topology.face_uvs(capped.topology.face_count() - 1);
  EXPECT_EQ(capped.uvs.row(last[0]), Eigen::RowVector2d(0.25, 0.75));
  // Nothing is added below hair that ends above the head.
  const Mesh above = cylinder(
      9, -60, [](double) { return 60; }, 11, 12);
  EXPECT_EQ(with_cap(above, head, head.topology.face_count(), {0, 0}).positions, above.positions);
}

TEST(MakeHumanGrooming, HairIsCutAtAHeight) {
  const Mesh hair = cylinder(
      9, -80, [](double) { return -40; }, -30, 9);
  const Mesh cut = cut_below(hair, -8.1);
  EXPECT_DOUBLE_EQ(cut.positions.col(1).minCoeff(), -8.1);
  EXPECT_DOUBLE_EQ(cut.positions.col(1).maxCoeff(), 9);
  EXPECT_EQ(cut.topology.vertex_count, cut.positions.rows());
  EXPECT_EQ(cut.positions.rows(), 41 * (1 + 4 * 8 + 1 + 4 * 9)) << "the row below -8.1 stays";
  EXPECT_EQ(cut_below(hair, -HUGE_VAL).positions, hair.positions);
}

TEST(MakeHumanGrooming, MirroredPolygonsKeepTheirFrontOutside) {
  const Mesh hair = cylinder(
      9, -80, [](double) { return -40; }, -2, 2);
  const Mesh other = mirrored(hair);
  const auto normal = [](const Mesh& mesh, Index f) -> Eigen::Vector3d {
    const auto corners = mesh.topology.face(f);
    const Eigen::Vector3d a = mesh.positions.row(corners[0]), b = mesh.positions.row(corners[1]),
                          c = mesh.positions.row(corners[2]);
    return (b - a).cross(c - a);
  };
  ASSERT_EQ(other.topology.face_count(), hair.topology.face_count());
  for (Index f = 0; f < hair.topology.face_count(); ++f) {
    const Eigen::Vector3d was = normal(hair, f), is = normal(other, f);
    EXPECT_LT((is - Eigen::Vector3d(-was.x(), was.y(), was.z())).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace crowdface::testing
