// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/surface_distance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "paint/sheets.h"

namespace crowdface::testing {
namespace {

TEST(SurfaceDistance, OnAPlaneItIsTheStraightWay) {
  const Sheet sheet(40);
  const SurfaceDistance surface(sheet.topology, sheet.positions);
  const SurfacePoint place = surface.nearest({0.113, -0.071, 0.4});
  EXPECT_NEAR(place.position.x(), 0.113, 1e-12);
  EXPECT_NEAR(place.position.z(), 0, 1e-12);
  const auto reached = surface.vertices_within({place}, 0.8);
  std::size_t inside = 0;
  for (Index v = 0; v < sheet.positions.rows(); ++v) {
    if ((sheet.positions.row(v).transpose() - place.position).norm() < 0.79) ++inside;
  }
  EXPECT_GE(reached.size(), inside);
  for (const auto& [vertex, distance] : reached) {
    const double straight = (sheet.positions.row(vertex).transpose() - place.position).norm();
    EXPECT_NEAR(distance, straight, 0.012 * straight + 1e-9);
  }
}

TEST(SurfaceDistance, ManyPlacesAreOne) {
  const Sheet sheet(20);
  const SurfaceDistance surface(sheet.topology, sheet.positions);
  const SurfacePoint a = surface.nearest({-0.5, 0, 0}), b = surface.nearest({0.5, 0.1, 0});
  std::vector<double> nearest(static_cast<std::size_t>(sheet.positions.rows()), 1e9);
  for (const SurfacePoint& place : {a, b}) {
    for (const auto& [v, d] : surface.vertices_within({place}, 0.7))
      nearest[v] = std::min(nearest[v], d);
  }
  for (const auto& [v, d] : surface.vertices_within({a, b}, 0.7)) EXPECT_NEAR(d, nearest[v], 0.02);
}

TEST(SurfaceDistance, AGapIsNotCrossedHoweverNarrow) {
  const Sheet sheet = folded_sheet(40);
  const SurfaceDistance surface(sheet.topology, sheet.positions);
  const SurfacePoint place = surface.nearest({0.6, 0, 0});
  for (const auto& [vertex, distance] : surface.vertices_within({place}, 0.55)) {
    EXPECT_EQ(sheet.positions(vertex, 2), 0) << "around the fold it is 0.6 and more";
  }
  bool other_side = false;
  for (const auto& [vertex, distance] : surface.vertices_within({place}, 0.75)) {
    if (sheet.positions(vertex, 2) == 0) continue;
    other_side = true;
    EXPECT_GT(distance, 0.59);
  }
  EXPECT_TRUE(other_side);
}

TEST(SurfaceDistance, PiecesWithOneRimAreOneSurface) {
  const Sheet sheet(10);
  const Index count = sheet.topology.vertex_count;
  Topology both = sheet.topology;
  both.vertex_count *= 2;
  for (Index f = 0; f < sheet.topology.face_count(); ++f) {
    std::vector<std::uint32_t> face(sheet.topology.face(f).begin(), sheet.topology.face(f).end());
    for (std::uint32_t& v : face) v += static_cast<std::uint32_t>(count);
    both.add_face(face);
  }
  Positions positions(2 * count, 3);
  positions << sheet.positions, sheet.positions;
  positions.bottomRows(count).col(0).array() += 2;  // beside it, rim on rim
  const SurfaceDistance surface(both, positions);
  const SurfacePoint place = surface.nearest({0.75, 0.03, 0});
  double farthest = 0;
  for (const auto& [vertex, distance] : surface.vertices_within({place}, 0.9)) {
    const double straight = (positions.row(vertex).transpose() - place.position).norm();
    EXPECT_NEAR(distance, straight, 0.1 * straight + 1e-9);
    farthest = std::max(farthest, positions(vertex, 0));
  }
  EXPECT_GT(farthest, 1.5);

  // The fold's own rims may meet as well: they are of one component, and stay two.
  Sheet closed = folded_sheet(10);
  closed.positions.col(2).setZero();
  const SurfaceDistance lips(closed.topology, closed.positions);
  const Adjacency edges = build_adjacency(closed.topology);
  for (std::uint32_t v = 0; v < closed.topology.vertex_count; ++v) {
    EXPECT_EQ(lips.adjacent_vertices(v).size(), edges.items_of(v).size());
  }
}

}  // namespace
}  // namespace crowdface::testing
