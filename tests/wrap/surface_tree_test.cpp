// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/surface_tree.h"

#include <gtest/gtest.h>

#include "crowdface/wrap/scan.h"
#include "head_models/synth/synthetic_head.h"

#include "support/meshes.h"

namespace crowdface::testing {
namespace {

/// The nearest of all triangles, one by one.
SurfaceHit nearest_of_all(const Positions& positions, const std::vector<Triangle>& triangles,
                          const Eigen::Vector3d& point) {
  SurfaceHit best;
  best.distance = 1e300;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    SurfaceHit hit = nearest_on_triangle(positions, triangles[t], point);
    hit.triangle = t;
    if (hit.distance < best.distance) best = hit;
  }
  return best;
}

TEST(SurfaceTree, FindsWhatASearchThroughAllTrianglesFinds) {
  const SyntheticHeads heads(5000);
  const Positions positions = heads.positions(1, 1);
  const std::vector<Triangle> triangles = triangles_of(heads.topology());
  const SurfaceTree tree(positions, triangles);
  const Positions points = 15 * random_positions(60, 3);
  for (Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d point = points.row(i).transpose();
    const SurfaceHit expected = nearest_of_all(positions, triangles, point);
    const SurfaceHit found = tree.nearest(point, 1e300);
    EXPECT_EQ(found.distance, expected.distance);
    EXPECT_EQ(found.triangle, expected.triangle);
    EXPECT_EQ(tree.nearest(point, 0.99 * expected.distance).triangle, kNoIndex) << "beyond reach";
  }
}

TEST(SurfaceTree, FindsTheNearestThatFacesAWayWhateverIsGuessed) {
  const SyntheticHeads heads(5000);
  const Positions positions = heads.positions(1, 1);
  const std::vector<Triangle> triangles = triangles_of(heads.topology());
  const Positions normals = vertex_normals_or_zero(triangles, positions);
  const SurfaceTree tree(positions, triangles);
  const Positions points = 15 * random_positions(60, 3), ways = random_positions(60, 4);
  for (Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d point = points.row(i).transpose();
    const Eigen::Vector3d way = ways.row(i).normalized().transpose();
    SurfaceHit expected;
    expected.distance = 1e300;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      const Eigen::RowVector3d facing = normals.row(a) + normals.row(b) + normals.row(c);
      if (facing.normalized() * way < 0.5) continue;
      SurfaceHit hit = nearest_on_triangle(positions, triangles[t], point);
      hit.triangle = t;
      if (hit.distance < expected.distance) expected = hit;
    }
    const auto other = static_cast<std::uint32_t>((i * 97) % static_cast<Index>(triangles.size()));
    for (const std::uint32_t guess : {kNoIndex, expected.triangle, other}) {
      const SurfaceHit found = tree.nearest_facing(point, way, 0.5, 1e300, guess);
      EXPECT_EQ(found.triangle, expected.triangle);
      EXPECT_EQ(found.distance, expected.distance);
      EXPECT_EQ(tree.nearest(point, 1e300, guess).triangle, tree.nearest(point, 1e300).triangle);
    }
  }
}

TEST(SurfaceTree, AHitIsTheWeightedMeanOfItsCorners) {
  Positions corners(3, 3);
  corners << 0, 0, 0, 2, 0, 0, 0, 2, 0;
  const Positions points = 3 * random_positions(200, 5);
  for (Index i = 0; i < points.rows(); ++i) {
    const SurfaceHit hit = nearest_on_triangle(corners, {0, 1, 2}, points.row(i).transpose());
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GE(hit.shares[k], 0);
      sum += hit.shares[k] * corners.row(static_cast<Index>(k));
    }
    EXPECT_LT((sum.transpose() - hit.point).norm(), 1e-12);
    // No place of a fine grid over the triangle is nearer.
    for (int a = 0; a <= 20; ++a) {
      for (int b = 0; a + b <= 20; ++b) {
        const Eigen::RowVector3d place(0.1 * a, 0.1 * b, 0);
        EXPECT_GE((points.row(i) - place).norm(), hit.distance - 1e-12);
      }
    }
  }
}

TEST(SurfaceTree, OnlyTrianglesThatFaceTheRightWayAreFound) {
  const std::vector<Triangle> triangles = triangles_of(cube_topology());
  const Positions positions = cube_positions();
  const SurfaceTree tree(positions, triangles);
  const Eigen::Vector3d inside(0.1, 0.2, 0.9);  // nearest to the face at z = 1
  EXPECT_NEAR(tree.nearest(inside, 10).point.z(), 1, 1e-12);
  EXPECT_NEAR(tree.nearest_facing(inside, -Eigen::Vector3d::UnitZ(), 0.5, 10).point.z(), -1, 1e-12);
  EXPECT_EQ(tree.nearest_facing(inside, -Eigen::Vector3d::UnitZ(), 0.5, 1).triangle, kNoIndex);
}

}  // namespace
}  // namespace crowdface::testing
