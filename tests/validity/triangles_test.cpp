// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/triangles.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "support/meshes.h"

namespace crowdface {
namespace {

Positions rows(std::initializer_list<Eigen::Vector3d> points) {
  Positions positions(static_cast<Index>(points.size()), 3);
  Index i = 0;
  for (const Eigen::Vector3d& p : points) positions.row(i++) = p.transpose();
  return positions;
}

TEST(Triangles, CrossingIsToldFromTouchingAndFromMissing) {
  const auto crosses = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
    const Positions positions = rows({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, a, b, c});
    const bool one = triangles_intersect(positions, {0, 1, 2}, {3, 4, 5});
    EXPECT_EQ(one, triangles_intersect(positions, {4, 5, 3}, {2, 0, 1}));
    return one;
  };
  EXPECT_TRUE(crosses({1, 1, -1}, {1, 1, 1}, {2, 1, 1}));
  EXPECT_TRUE(crosses({-1, 1, 0.05}, {9, 1, -0.95}, {1, 1, 7}));
  EXPECT_FALSE(crosses({1, 1, 0}, {1, 1, 1}, {2, 1, 1})) << "a corner on the plane";
  EXPECT_FALSE(crosses({1, 1, 0.1}, {1, 1, 1}, {2, 1, 1})) << "above";
  EXPECT_FALSE(crosses({3, 3, -1}, {3, 3, 1}, {4, 3, 1})) << "through the plane, beside";
  EXPECT_FALSE(crosses({1, 1, 0}, {2, 1, 0}, {1, 2, 0})) << "in the plane";
}

/// Whether an edge of one passes through the other, by solving for the point.
bool edges_pierce(const Positions& p, const Triangle& a, const Triangle& b) {
  for (std::size_t e = 0; e < 3; ++e) {
    const Eigen::Vector3d from = p.row(a[e]), to = p.row(a[(e + 1) % 3]);
    Eigen::Matrix3d m;
    const Eigen::Vector3d o = p.row(b[0]);
    m.col(0) = p.row(b[1]).transpose() - o;
    m.col(1) = p.row(b[2]).transpose() - o;
    m.col(2) = from - to;
    const Eigen::Vector3d x = m.fullPivLu().solve(from - o);
    if (x[0] > 0 && x[1] > 0 && x[0] + x[1] < 1 && x[2] > 0 && x[2] < 1) return true;
  }
  return false;
}

TEST(Triangles, CrossingIsAnEdgeThroughOneOfThem) {
  int crossing = 0;
  for (std::uint64_t n = 0; n < 3000; ++n) {
    const Positions p = testing::random_positions(6, n);
    const bool expected =
        edges_pierce(p, {0, 1, 2}, {3, 4, 5}) || edges_pierce(p, {3, 4, 5}, {0, 1, 2});
    EXPECT_EQ(triangles_intersect(p, {0, 1, 2}, {3, 4, 5}), expected) << n;
    crossing += expected ? 1 : 0;
  }
  EXPECT_GT(crossing, 300);
  EXPECT_LT(crossing, 2700);
}

TEST(Triangles, FlipsCollapsesAndStretchAreSeen) {
  const Topology grid = testing::grid_topology(20, 20);
  const Components parts = find_components(build_adjacency(grid));
  const auto triangles = triangles_of(grid, parts, parts.largest());
  ASSERT_EQ(triangles.size(), 800U);
  Positions flat(grid.vertex_count, 3);
  for (Index i = 0; i < flat.rows(); ++i) {
    flat.row(i) << static_cast<double>(i % 21), static_cast<double>(i / 21), 0;
  }
  const TargetTriangles target(triangles, flat);
  const LocalDefects same = target.compare(flat);
  EXPECT_EQ(same.compared_triangle_count, 800);
  EXPECT_EQ(same.flipped_triangle_count, 0);
  EXPECT_NEAR(same.stretch_factor, 1, 1e-12);

  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const LocalDefects turned = target.compare((flat * turn).eval());
  EXPECT_EQ(turned.flipped_triangle_count, 0);
  EXPECT_NEAR(turned.stretch_factor, 1, 1e-9);

  Positions stretched = flat;
  stretched.col(0) *= 2.5;
  stretched.col(1) += 0.3 * flat.col(0);
  // The shear and stretch matrix [[2.5, 0], [0.3, 1]] by its larger singular value.
  Eigen::Matrix2d map;
  map << 2.5, 0, 0.3, 1;
  EXPECT_NEAR(target.compare(stretched).stretch_factor, map.jacobiSvd().singularValues()(0), 1e-9);

  Positions mirrored = flat;
  mirrored.col(0) *= -1;
  EXPECT_EQ(target.compare(mirrored).flipped_triangle_count, 800);
  Positions pulled = flat;
  pulled.row(220) << 14.5, 10, 0;  // one vertex far over its neighbours
  EXPECT_GE(target.compare(pulled).flipped_triangle_count, 2);
  EXPECT_LE(target.compare(pulled).flipped_triangle_count, 6);
  Positions thin = flat;
  thin.col(1) *= 0.01;
  EXPECT_EQ(target.compare(thin).flipped_triangle_count, 800) << "collapsed";
}

}  // namespace
}  // namespace crowdface
