// SPDX-License-Identifier: Apache-2.0
#include "crowdface/preview/reduced_mesh.h"

#include <algorithm>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/core/require.h"
#include "crowdface/mesh/all_columns.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

using testing::grid_topology;

Positions flat_grid(Index columns, Index rows) {
  Positions positions(static_cast<Index>((columns + 1) * (rows + 1)), 3);
  for (Index y = 0; y <= rows; ++y) {
    for (Index x = 0; x <= columns; ++x) {
      positions.row(y * (columns + 1) + x) =
          Eigen::RowVector3d(static_cast<double>(x), static_cast<double>(y), 0);
    }
  }
  return positions;
}

double area(const ReducedMesh& mesh, const Positions& positions) {
  double sum = 0;
  const Positions places = positions(mesh.vertices, kAllColumns);
  for (const Triangle& triangle : mesh.triangles) sum += area_vector(places, triangle).norm() / 2;
  return sum;
}

TEST(ReducedMesh, OfAMeshThatIsSmallEnoughIsTheMesh) {
  const ReducedMesh mesh = reduce_mesh(triangles_of(grid_topology(3, 2)), flat_grid(3, 2), 12);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_EQ(mesh.vertices.size(), 12U);
  EXPECT_DOUBLE_EQ(area(mesh, flat_grid(3, 2)), 6.0);
}

TEST(ReducedMesh, OfAFlatSheetCoversTheSameAreaWithFewTriangles) {
  const ReducedMesh mesh = reduce_mesh(triangles_of(grid_topology(40, 40)), flat_grid(40, 40), 60);
  EXPECT_LE(mesh.triangles.size(), 60U);
  EXPECT_NEAR(area(mesh, flat_grid(40, 40)), 1600, 1e-9);
}

TEST(ReducedMesh, NamesEachVertexOnceAndUsesAll) {
  const ReducedMesh mesh = reduce_mesh(triangles_of(grid_topology(30, 20)), flat_grid(30, 20), 100);
  const std::set<std::uint32_t> once(mesh.vertices.begin(), mesh.vertices.end());
  EXPECT_EQ(once.size(), mesh.vertices.size());
  std::set<std::uint32_t> used;
  for (const Triangle& triangle : mesh.triangles) used.insert(triangle.begin(), triangle.end());
  EXPECT_EQ(used.size(), mesh.vertices.size());
  EXPECT_EQ(*used.rbegin() + 1, mesh.vertices.size());
}

// Half of the triangles of a face went to teeth behind closed lips.
TEST(ReducedMesh, WhatNobodySeesGetsFewTrianglesAndNoGapOpens) {
  const Positions sheet = flat_grid(40, 40);
  const std::vector<Triangle> whole = triangles_of(grid_topology(40, 40));
  ASSERT_EQ(whole.size(), 3200U);
  const auto lies_right = [&](const Triangle& triangle) {
    double sum = 0;
    for (const std::uint32_t corner : triangle) sum += sheet(corner, 0);
    return sum > 3 * 20;
  };
  std::vector<bool> hidden;
  for (const Triangle& triangle : whole) hidden.push_back(lies_right(triangle));
  const std::vector<Triangle> few = reduce_hidden(whole, sheet, hidden, 1000, 200);
  const auto right = static_cast<std::size_t>(std::ranges::count_if(few, lies_right));
  EXPECT_LE(right, 200U);
  EXPECT_LE(few.size(), 1000U);
  EXPECT_GE(few.size() - right, 700U) << "the rest is for what is seen";
  double covered = 0;
  std::set<std::uint32_t> used;
  for (const Triangle& triangle : few) {
    covered += area_vector(sheet, triangle).norm() / 2;
    used.insert(triangle.begin(), triangle.end());
  }
  EXPECT_NEAR(covered, 1600, 1e-9);
  for (std::uint32_t y = 0; y <= 40; ++y) {  // where they meet every vertex stays
    EXPECT_TRUE(used.contains(y * 41 + 20)) << y;
  }
  EXPECT_THROW(reduce_hidden(whole, sheet, {true}, 9, 9), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
