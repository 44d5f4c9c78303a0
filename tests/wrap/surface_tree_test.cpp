// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/surface_tree.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/scan_surface.h"
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
      EXPECT_GE(hit.barycentric[k], 0);
      sum += hit.barycentric[k] * corners.row(static_cast<Index>(k));
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

// The shares of a place on an edge are rounded. Above the rim of a scan of a face, the skull was
// once said to be far from the scan, where the scan has no data.
TEST(ScanSurface, APlaceOnARimIsToldFromOthersWhateverIsRounded) {
  constexpr std::uint32_t kSteps = 40, kRows = 3;
  Scan scan;
  scan.positions.resize(kRows * (kSteps + 1), 3);
  for (std::uint32_t i = 0; i <= kSteps; ++i) {
    const double angle = 0.07 * i;
    for (std::uint32_t k = 0; k < kRows; ++k) {
      const std::uint32_t v = kRows * i + k;
      const double radius = 0.5 + 0.25 * k;
      scan.positions.row(v) << radius * std::cos(angle), radius * std::sin(angle),
          0.1 * k * std::sin(9 * angle);
      if (i == kSteps || k + 1 == kRows) continue;
      scan.triangles.push_back({v, v + 1, v + kRows});
      scan.triangles.push_back({v + kRows, v + 1, v + kRows + 1});
    }
  }
  // An edge on the rim may be any side of its triangle.
  for (std::size_t t = 0; t < scan.triangles.size(); ++t) {
    Triangle& corners = scan.triangles[t];
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(t / 4 % 3),
                corners.end());
  }
  const ScanSurface surface(scan);
  for (int i = 20; i < 380; ++i) {
    const double angle = 2.8 * i / 400;
    const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0);
    EXPECT_TRUE(surface.nearest(1.7 * direction, 1e300).is_on_boundary) << angle;
    EXPECT_FALSE(surface.nearest(0.7 * direction, 1e300).is_on_boundary) << angle;
  }
}

}  // namespace
}  // namespace crowdface::testing
