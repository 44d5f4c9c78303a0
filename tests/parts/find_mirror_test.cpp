// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/find_mirror.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/meshes.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kSide = 40;
const Eigen::Vector3d kAcross = {1, 0, 0};

/// A bowl of quads on a grid, symmetric in x to the bit but for what `bump` adds to its depth.
template <class Bump>
Positions bowl(const Bump& bump) {
  Positions positions((kSide + 1) * (kSide + 1), 3);
  for (std::uint32_t row = 0; row <= kSide; ++row) {
    for (std::uint32_t column = 0; column <= kSide; ++column) {
      const double s = (2. * column - kSide) / kSide, t = (2. * row - kSide) / kSide;
      positions.row(row * (kSide + 1) + column) << 7 * s, 8 * t,
          6 - 3 * (s * s + t * t) + std::exp(-9 * (s * s + (t - 0.2) * (t - 0.2))) + bump(s, t);
    }
  }
  return positions;
}
Positions even_bowl() {
  return bowl([](double, double) { return 0.0; });
}
double swelling(double s, double t) {
  return 0.3 * std::exp(-8 * ((s - 0.4) * (s - 0.4) + t * t));
}

FoundMirror found_on(const Topology& topology, const Positions& mean) {
  return find_mirror(topology, find_components(build_adjacency(topology)), mean, kAcross);
}

TEST(FindMirror, OfASymmetricHeadIsItself) {
  const Topology topology = testing::grid_topology(kSide, kSide);
  const Positions mean = even_bowl();
  const FoundMirror found = found_on(topology, mean);
  EXPECT_EQ(found.paired_vertex_count, mean.rows());
  EXPECT_EQ(found.rms_distance, 0);
  EXPECT_EQ(found.map.plane.normal, kAcross);
  EXPECT_EQ(found.map.plane.offset, 0);
  const Positions image = mirrored(found.map, mean);
  EXPECT_EQ(image, mean);
  for (const double w : {-0.4, 0.0, 0.3, 0.5, 1.0, 1.2}) {
    EXPECT_EQ(blend_with_mirrored(mean, image, w), mean);
  }
}

TEST(FindMirror, MirroringTwiceGivesTheFaceBack) {
  const Topology topology = testing::grid_topology(kSide, kSide);
  const FoundMirror found = found_on(topology, even_bowl());
  const Positions face = bowl(swelling) + 0.01 * testing::random_positions(even_bowl().rows(), 3);
  const Positions image = mirrored(found.map, face);
  EXPECT_NE(image, face);
  EXPECT_EQ(mirrored(found.map, image), face);
  EXPECT_EQ(blend_with_mirrored(face, image, 0), face);
  EXPECT_EQ(blend_with_mirrored(face, image, 1), image);
  const Positions even = blend_with_mirrored(face, image, 0.5);
  EXPECT_LT((mirrored(found.map, even) - even).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(FindMirror, FacesTellPartnersHoweverUnlikeTheSidesAre) {
  const Topology topology = testing::grid_topology(kSide, kSide);
  const Positions mean = bowl(swelling);
  const FoundMirror found = found_on(topology, mean);
  EXPECT_EQ(found.paired_vertex_count, mean.rows());
  EXPECT_GT(found.max_distance, 0.1);
  for (std::uint32_t v = 0; v < mean.rows(); ++v) {
    const std::uint32_t row = v / (kSide + 1), column = v % (kSide + 1);
    ASSERT_EQ(found.map.corners[v][0], row * (kSide + 1) + kSide - column);
  }
}

TEST(FindMirror, ThePlaneGoesWithAHeadThatStandsElsewhere) {
  const Topology topology = testing::grid_topology(kSide, kSide);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.06, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::RowVector3d moved(0.4, -2, 7);
  const Positions mean = (even_bowl() * turn.transpose()).rowwise() + moved;
  const FoundMirror found = found_on(topology, mean);
  EXPECT_EQ(found.paired_vertex_count, mean.rows());
  EXPECT_LT(found.max_distance, 1e-9);
  EXPECT_LT((found.map.plane.normal - turn * kAcross).norm(), 1e-9);
  const Positions face = mean + 0.1 * testing::random_positions(mean.rows(), 3);
  EXPECT_LT((mirrored(found.map, mirrored(found.map, face)) - face).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FindMirror, VerticesWithoutPartnersGetPlacesOnTheSurface) {
  // Columns that stand closer on one side, and triangles that all lean one way.
  Topology topology;
  const Topology quads = testing::grid_topology(kSide, kSide);
  topology.vertex_count = quads.vertex_count;
  for (Index f = 0; f < quads.face_count(); ++f) {
    const auto face = quads.face(f);
    topology.add_face(std::array{face[0], face[1], face[2]});
    topology.add_face(std::array{face[0], face[2], face[3]});
  }
  Positions mean = even_bowl();
  for (Index i = 0; i < mean.rows(); ++i) {
    const double s = mean(i, 0) / 7, t = mean(i, 1) / 8, u = s + 0.2 * (1 - s * s);
    mean.row(i) << 7 * u, 8 * t,
        6 - 3 * (u * u + t * t) + std::exp(-9 * (u * u + (t - 0.2) * (t - 0.2)));
  }
  const FoundMirror found = found_on(topology, mean);
  EXPECT_GT(found.surface_mirrored_vertex_count, mean.rows() / 2);
  EXPECT_GT(found.partner_fraction(), 0.99);
  EXPECT_LT(found.rms_distance, 0.03);
  EXPECT_LT((mirrored(found.map, mean) - mean).rowwise().norm().maxCoeff(),
            found.max_distance + 1e-12);
}

/// The bowl and cubes before it.
struct BowlWithCubes {
  explicit BowlWithCubes(const std::vector<Eigen::RowVector3d>& places)
      : topology(testing::grid_topology(kSide, kSide)), mean(even_bowl()) {
    const Topology cube = testing::cube_topology();
    for (const Eigen::RowVector3d& place : places) {
      const auto first = static_cast<std::uint32_t>(mean.rows());
      mean.conservativeResize(mean.rows() + 8, 3);
      mean.bottomRows(8) = testing::cube_positions(0.3).rowwise() + place;
      for (Index f = 0; f < cube.face_count(); ++f) {
        std::vector<std::uint32_t> face;
        for (const std::uint32_t v : cube.face(f)) face.push_back(first + v);
        topology.add_face(face);
      }
    }
    topology.vertex_count = mean.rows();
  }
  Topology topology;
  Positions mean;
};

TEST(FindMirror, EyesChangePlaces) {
  const BowlWithCubes head({{-3, 2, 8}, {3, 2, 8}});
  const FoundMirror found = found_on(head.topology, head.mean);
  EXPECT_EQ(found.paired_vertex_count, head.mean.rows());
  const auto left = static_cast<std::uint32_t>(head.mean.rows() - 16);
  for (std::uint32_t v = left; v < left + 8; ++v) EXPECT_GE(found.map.corners[v][0], left + 8);
  EXPECT_EQ(mirrored(found.map, head.mean), head.mean);
}

TEST(FindMirror, WhatIsOnOneSideOnlyKeepsItsForm) {
  const BowlWithCubes head({{-3, 2, 8}});
  const FoundMirror found = found_on(head.topology, head.mean);
  EXPECT_EQ(found.map.unpaired_vertices.size(), 8U);
  EXPECT_EQ(found.paired_vertex_count, head.mean.rows() - 8);
  const Positions moved = mirrored(found.map, head.mean) - head.mean;
  // But for the reach within which nothing is kept.
  EXPECT_LT(moved.rowwise().norm().maxCoeff(), 0.17);
}

}  // namespace
}  // namespace crowdface
