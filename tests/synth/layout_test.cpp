// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/mesh/adjacency.h"
#include "head_models/synth/quad_counts.h"

namespace crowdface::synth {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Every directed edge with the number of faces that run along it.
std::map<Edge, int> directed_edges(const Topology& topology) {
  std::map<Edge, int> out;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) ++out[{face[k], face[(k + 1) % face.size()]}];
  }
  return out;
}

/// The closed loops of edges with one face.
int count_boundary_loops(const Topology& topology) {
  const auto edges = directed_edges(topology);
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [edge, faces] : edges) {
    if (edges.contains({edge.second, edge.first})) continue;
    EXPECT_FALSE(next.contains(edge.first)) << "two holes meet at vertex " << edge.first;
    next[edge.first] = edge.second;
  }
  int loops = 0;
  while (!next.empty()) {
    ++loops;
    std::uint32_t at = next.begin()->first;
    for (auto it = next.find(at); it != next.end(); it = next.find(at)) {
      at = it->second;
      next.erase(it);
    }
  }
  return loops;
}

class LayoutAt : public ::testing::TestWithParam<Index> {};

TEST_P(LayoutAt, HasNearlyTheWantedSize) {
  const Index wanted = GetParam();
  const Layout layout = make_layout(wanted);
  EXPECT_NEAR(static_cast<double>(layout.topology.vertex_count), static_cast<double>(wanted),
              0.1 * static_cast<double>(wanted));
  EXPECT_EQ(layout.topology.vertex_count, nearest_counts(wanted).vertex_count());
  EXPECT_EQ(layout.lattice_points.size(), static_cast<std::size_t>(layout.topology.vertex_count));
}

TEST_P(LayoutAt, IsOneManifoldPieceOfQuadsWithSixHoles) {
  const Layout layout = make_layout(GetParam());
  const Topology& topology = layout.topology;
  for (Index f = 0; f < topology.face_count(); ++f) {
    ASSERT_EQ(topology.face(f).size(), 4U);
    const std::set<std::uint32_t> distinct(topology.face(f).begin(), topology.face(f).end());
    ASSERT_EQ(distinct.size(), 4U);
  }
  // No edge is run along twice in the same direction: manifold and oriented alike.
  for (const auto& [edge, faces] : directed_edges(topology)) ASSERT_EQ(faces, 1);
  EXPECT_EQ(count_boundary_loops(topology), 6);  // pupils, mouth, nostrils, neck
  const Components components = find_components(build_adjacency(topology));
  EXPECT_EQ(components.count(), 1);
  // Euler: a sphere with six holes.
  const auto edges = static_cast<Index>((topology.corner_count() +
                                         [&] {
                                           Index open = 0;
                                           const auto all = directed_edges(topology);
                                           for (const auto& [e, n] : all)
                                             open += all.contains({e.second, e.first}) ? 0 : 1;
                                           return open;
                                         }()) /
                                        2);
  EXPECT_EQ(topology.vertex_count - edges + topology.face_count(), 2 - 6);
}

double corner_area(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b,
                   const Eigen::RowVector2d& c) {
  return ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x())) / 2;
}

TEST_P(LayoutAt, UnwrapsWithoutFlipsInsideTheTile) {
  const Layout layout = make_layout(GetParam());
  EXPECT_GE(layout.uvs.minCoeff(), 0);
  EXPECT_LE(layout.uvs.maxCoeff(), 1);
  const double even = 1.0 / static_cast<double>(layout.topology.face_count());
  for (Index f = 0; f < layout.topology.face_count(); ++f) {
    std::array<Eigen::RowVector2d, 4> uv;
    for (std::size_t k = 0; k < 4; ++k) {
      uv[k] = layout.uvs.row(layout.topology.corner_uvs[static_cast<std::size_t>(f) * 4 + k]);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_GT(corner_area(uv[k], uv[(k + 1) % 4], uv[(k + 3) % 4]), 0.005 * even) << "face " << f;
    }
  }
}

TEST_P(LayoutAt, UnwrapsWithoutOverlaps) {
  const Layout layout = make_layout(GetParam());
  constexpr int kSize = 700;
  std::vector<int> covered(static_cast<std::size_t>(kSize) * kSize, 0);
  for (Index f = 0; f < layout.topology.face_count(); ++f) {
    std::array<Eigen::RowVector2d, 4> uv;
    for (std::size_t k = 0; k < 4; ++k) {
      uv[k] = layout.uvs.row(layout.topology.corner_uvs[static_cast<std::size_t>(f) * 4 + k]);
    }
    Eigen::RowVector2d low = uv[0], high = uv[0];
    for (const auto& p : uv) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const auto first = [](double x) { return static_cast<int>(std::floor(x * kSize)); };
    for (int y = first(low.y()); y <= std::min(first(high.y()), kSize - 1); ++y) {
      for (int x = first(low.x()); x <= std::min(first(high.x()), kSize - 1); ++x) {
        // Off the pixel's middle, so that no edge is hit exactly.
        const Eigen::RowVector2d p((x + 0.5137) / kSize, (y + 0.4871) / kSize);
        bool inside = true;
        for (std::size_t k = 0; k < 4; ++k) inside &= corner_area(uv[k], uv[(k + 1) % 4], p) > 0;
        if (inside) ++covered[static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x)];
      }
    }
  }
  EXPECT_EQ(*std::max_element(covered.begin(), covered.end()), 1);
  const auto used = std::count(covered.begin(), covered.end(), 1);
  EXPECT_GT(used, kSize * kSize / 2);
}

INSTANTIATE_TEST_SUITE_P(Sizes, LayoutAt, ::testing::Values(5000, 20000, 80000));

TEST(Layout, ReachesEverySizeWithinTenPercent) {
  for (double wanted = 5000; wanted <= 1200000; wanted *= 1.13) {
    const auto found =
        static_cast<double>(nearest_counts(static_cast<Index>(wanted)).vertex_count());
    EXPECT_NEAR(found / wanted, 1, 0.1) << wanted;
  }
}

TEST(Layout, CutsOnlyAlongTheSeams) {
  const Layout layout = make_layout(5000);
  // A vertex has at most two texture coordinates (three where the cap's seam meets the back's).
  std::map<std::uint32_t, std::set<std::uint32_t>> uvs_of;
  for (std::size_t c = 0; c < layout.topology.corner_vertices.size(); ++c) {
    uvs_of[layout.topology.corner_vertices[c]].insert(layout.topology.corner_uvs[c]);
  }
  int split = 0;
  for (const auto& [vertex, uvs] : uvs_of) {
    EXPECT_LE(uvs.size(), 3U);
    if (uvs.size() == 1) continue;
    ++split;
    const LatticePoint& a = layout.lattice_points[vertex];
    EXPECT_EQ(a.patch, SkinPatch::kStrip);
    EXPECT_TRUE(a.b == 0 || std::abs(a.a) == column_distance(kColumns - 1));
  }
  EXPECT_GT(split, 0);
}

}  // namespace
}  // namespace crowdface::synth
