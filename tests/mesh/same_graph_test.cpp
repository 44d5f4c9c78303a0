// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/same_graph.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace crowdface::testing {
namespace {

/// A cube of quads with a fifth corner on one side, so that no turn maps it onto itself; and two
/// plain cubes beside it.
Mesh three_cubes() {
  Mesh mesh;
  for (int piece = 0; piece < 3; ++piece) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.rows());
    mesh.positions.conservativeResize(first + 8, 3);
    mesh.positions.bottomRows(8) = cube_positions().rowwise() + Eigen::RowVector3d(5 * piece, 0, 0);
    const Topology cube = cube_topology();
    for (Index f = piece == 0 ? 1 : 0; f < cube.face_count(); ++f) {
      std::vector<std::uint32_t> face(cube.face(f).begin(), cube.face(f).end());
      for (std::uint32_t& v : face) v += first;
      mesh.topology.add_face(face);
    }
  }
  mesh.topology.vertex_count = mesh.positions.rows();
  return mesh;
}

/// With vertices, faces and the first corners of faces in another order.
/// \param to  the new number of each vertex
Mesh shuffled(const Mesh& mesh, const std::vector<std::uint32_t>& to, std::mt19937& random) {
  Mesh other;
  other.topology.vertex_count = mesh.topology.vertex_count;
  other.positions.resize(mesh.positions.rows(), 3);
  for (std::size_t v = 0; v < to.size(); ++v) {
    other.positions.row(to[v]) = mesh.positions.row(static_cast<Index>(v));
  }
  std::vector<Index> faces(static_cast<std::size_t>(mesh.topology.face_count()));
  std::iota(faces.begin(), faces.end(), 0);
  std::shuffle(faces.begin(), faces.end(), random);
  for (const Index f : faces) {
    std::vector<std::uint32_t> face(mesh.topology.face(f).begin(), mesh.topology.face(f).end());
    for (std::uint32_t& v : face) v = to[v];
    std::rotate(face.begin(), face.begin() + random() % face.size(), face.end());
    other.topology.add_face(face);
  }
  return other;
}

TEST(SameGraph, FindsVerticesInAnotherOrder) {
  const Mesh mesh = three_cubes();
  std::mt19937 random(5);
  for (int i = 0; i < 20; ++i) {
    std::vector<std::uint32_t> to(static_cast<std::size_t>(mesh.positions.rows()));
    std::iota(to.begin(), to.end(), 0U);
    std::shuffle(to.begin(), to.end(), random);
    const Mesh other = shuffled(mesh, to, random);
    // Moved and somewhat out of shape: the symmetric cubes are told by where they are.
    Positions moved = other.positions.rowwise() + Eigen::RowVector3d(1, 2, 3);
    for (Index v = 0; v < moved.rows(); ++v) moved(v, v % 3) += 0.05 * static_cast<double>(v % 5);
    EXPECT_EQ(match_graphs(mesh.topology, mesh.positions, other.topology, moved), to);
  }
}

TEST(SameGraph, TellsOtherGraphs) {
  const Mesh mesh = three_cubes();
  std::vector<std::uint32_t> to(static_cast<std::size_t>(mesh.positions.rows()));
  std::iota(to.begin(), to.end(), 0U);
  Mesh other = mesh;
  std::swap(other.topology.corner_vertices[0], other.topology.corner_vertices[1]);
  EXPECT_FALSE(match_graphs(mesh.topology, mesh.positions, other.topology, other.positions));
  other = mesh;
  // Inside out.
  for (Index f = 0; f < other.topology.face_count(); ++f) {
    const auto [begin, end] = other.topology.corners(f);
    std::reverse(other.topology.corner_vertices.begin() + begin,
                 other.topology.corner_vertices.begin() + end);
  }
  const auto turned = match_graphs(mesh.topology, mesh.positions, other.topology, other.positions);
  EXPECT_NE(turned, to);
  EXPECT_FALSE(
      match_graphs(mesh.topology, mesh.positions, triangulated(mesh.topology, 0), mesh.positions));
}

/// A thin plate whose two sides are quads with three common corners, 0, 1 and 2, as in teeth.
Topology plate() {
  Topology topology;
  topology.vertex_count = 6;
  topology.add_face(std::array{0U, 1U, 2U, 3U});
  topology.add_face(std::array{2U, 1U, 0U, 4U});
  topology.add_face(std::array{0U, 3U, 5U, 4U});
  return topology;
}

// Cutting both quads along their common diagonal gives an edge of four triangles.
TEST(SameGraph, MatchesQuadsThatShareThreeVertices) {
  Mesh mesh;
  mesh.topology = triangulated(plate(), 0);
  mesh.positions = Positions::Random(6, 3);
  std::mt19937 random(2);
  const std::vector<std::uint32_t> to = {3, 5, 1, 0, 4, 2};
  const Mesh other = shuffled(mesh, to, random);
  EXPECT_EQ(match_graphs(mesh.topology, mesh.positions, other.topology, other.positions), to);
}

TEST(HasSamePolygons, WhateverTheOrderAndTheDiagonals) {
  const Topology quads = plate();
  Topology mixed;
  mixed.vertex_count = 6;
  for (const auto& face :
       {std::array{5U, 4U, 0U}, std::array{0U, 1U, 2U}, std::array{2U, 3U, 0U},
        std::array{4U, 2U, 1U}, std::array{1U, 0U, 4U}, std::array{0U, 3U, 5U}}) {
    mixed.add_face(face);
  }
  const Topology one = triangulated(quads, 0), other = triangulated(quads, 1);
  const std::array<Topology, 4> all = {quads, one, other, mixed};
  for (const Topology& a : all) {
    for (const Topology& b : all) EXPECT_TRUE(has_same_polygons(a, b));
  }
  Topology turned = mixed;
  std::swap(turned.corner_vertices[0], turned.corner_vertices[1]);
  EXPECT_FALSE(has_same_polygons(quads, turned));
  Topology missing = mixed;
  missing.corner_vertices[0] = 1;
  EXPECT_FALSE(has_same_polygons(quads, missing));
  EXPECT_FALSE(has_same_polygons(missing, other));
}

TEST(HasSamePolygons, CutInAnyWay) {
  Topology hexagons, fans, zigzags, other;
  for (Topology* all : {&hexagons, &fans, &zigzags, &other}) all->vertex_count = 10;
  hexagons.add_face(std::array{0U, 1U, 2U, 3U, 4U, 5U});
  hexagons.add_face(std::array{3U, 2U, 6U, 7U, 8U, 9U});
  const auto cut = [](Topology& to, const std::array<std::uint32_t, 12>& diagonals) {
    for (const std::uint32_t first : {0U, 6U}) {
      constexpr std::array<std::array<std::uint32_t, 6>, 2> kHexagons = {
          {{0, 1, 2, 3, 4, 5}, {3, 2, 6, 7, 8, 9}}};
      const auto& h = kHexagons[first / 6];
      for (std::uint32_t i = 0; i < 12; i += 3) {
        to.add_face(std::array{h[diagonals[i]], h[diagonals[i + 1]], h[diagonals[i + 2]]});
      }
    }
  };
  cut(fans, {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5});
  cut(zigzags, {0, 1, 5, 1, 2, 5, 2, 4, 5, 2, 3, 4});
  const std::array<Topology, 3> same = {hexagons, fans, zigzags};
  for (const Topology& a : same) {
    for (const Topology& b : same) EXPECT_TRUE(has_same_polygons(a, b));
  }
  cut(other, {1, 0, 5, 1, 2, 5, 2, 4, 5, 2, 3, 4});  // one triangle is reversed
  EXPECT_FALSE(has_same_polygons(hexagons, other));
  // A vertex in the middle of a square is no corner of the square's border.
  Topology square, star;
  for (Topology* both : {&square, &star}) both->vertex_count = 6;
  for (std::uint32_t i = 0; i < 4; ++i) star.add_face(std::array{i, (i + 1) % 4, 4U});
  for (std::uint32_t i = 0; i < 4; ++i) square.add_face(std::array{i, (i + 1) % 4, 5U});
  EXPECT_FALSE(has_same_polygons(square, star));
}

TEST(Triangulated, CutsQuadsEitherWay) {
  Topology quad;
  quad.vertex_count = 4;
  quad.add_face(std::array{0U, 1U, 2U, 3U});
  EXPECT_EQ(triangulated(quad, 0).corner_vertices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(triangulated(quad, 1).corner_vertices, (std::vector<std::uint32_t>{1, 2, 3, 1, 3, 0}));
}

}  // namespace
}  // namespace crowdface::testing
