// SPDX-License-Identifier: Apache-2.0
#include "multiscale_faces/front_patch.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "crowdface/cast/compared_area.h"
#include "crowdface/core/error.h"

namespace crowdface::multiscale {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Maps each vertex on a rim to the next vertex along the rim. Each entry is a directed edge of a
/// triangle; the reverse edge belongs to no triangle. A vertex at which a rim touches itself has
/// several entries.
std::multimap<std::uint32_t, std::uint32_t> rim_edges(const std::vector<Triangle>& triangles) {
  std::set<Edge> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.emplace(t[i], t[(i + 1) % 3]);
  }
  std::multimap<std::uint32_t, std::uint32_t> next;
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) next.emplace(from, to);
  }
  return next;
}

/// Keeps the triangles of the component with the most vertices.
void keep_largest(std::vector<Triangle>& triangles, Index vertex_count) {
  const Components components =
      find_components(build_adjacency(topology_of(triangles, vertex_count)));
  const std::uint32_t largest = components.largest();
  std::erase_if(triangles,
                [&](const Triangle& t) { return components.component_of_vertex[t[0]] != largest; });
}

/// Removes triangles until no rim touches itself and no triangle has all corners on rims. A
/// triangle with all corners on rims could become flat on a side of the square.
void tidy_rims(std::vector<Triangle>& triangles, Index vertex_count) {
  for (;;) {
    keep_largest(triangles, vertex_count);
    const auto next = rim_edges(triangles);
    const std::size_t before = triangles.size();
    std::erase_if(triangles, [&](const Triangle& t) {
      return std::ranges::any_of(t, [&](std::uint32_t v) { return next.count(v) > 1; }) ||
             std::ranges::all_of(t, [&](std::uint32_t v) { return next.contains(v); });
    });
    if (triangles.size() == before) return;
  }
}

std::vector<std::vector<std::uint32_t>> rims_of(const std::vector<Triangle>& triangles) {
  auto next = rim_edges(triangles);
  std::vector<std::vector<std::uint32_t>> rims;
  while (!next.empty()) {
    std::vector<std::uint32_t> rim;
    for (auto edge = next.begin(); edge != next.end(); edge = next.find(rim.back())) {
      if (rim.empty()) rim.push_back(edge->first);
      const std::uint32_t to = edge->second;
      next.erase(edge);
      if (to == rim.front()) break;
      rim.push_back(to);
    }
    rims.push_back(std::move(rim));
  }
  return rims;
}

}  // namespace

Positions FrontPatch::rows_of(const Positions& head) const {
  Positions rows(vertex_count(), 3);
  for (Index i = 0; i < rows.rows(); ++i) {
    rows.row(i) = head.row(static_cast<Index>(head_vertices[static_cast<std::size_t>(i)]));
  }
  return rows;
}

FrontPatch front_patch(const Topology& topology, const Positions& mean, Axis up, Axis front) {
  const Components components = find_components(build_adjacency(topology));
  const std::vector<double> areas =
      compared_vertex_areas(topology, components, mean, ComparedArea::kFront, front);
  std::vector<Triangle> triangles = triangles_of(topology);
  std::erase_if(triangles, [&](const Triangle& t) {
    return std::ranges::any_of(t, [&](std::uint32_t v) { return !(areas[v] > 0); }) ||
           area_vector(mean, t)[front.index] * front.sign <= 0;
  });
  if (triangles.empty()) throw InvalidInput("the heads have no skin in front of their middle");
  tidy_rims(triangles, topology.vertex_count);

  FrontPatch patch;
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
  patch.head_vertices = renumber(corners, topology.vertex_count);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    patch.triangles.push_back({corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]});
  }

  std::vector<std::vector<std::uint32_t>> rims = rims_of(patch.triangles);
  if (rims.empty()) throw InvalidInput("the front of the heads has no border");
  std::ranges::sort(rims, {}, [](const auto& rim) { return -static_cast<Index>(rim.size()); });
  patch.border = std::move(rims.front());
  patch.hole_rims.assign(std::make_move_iterator(rims.begin() + 1),
                         std::make_move_iterator(rims.end()));

  // The patch's border is mapped to a square. The square's corners are the border vertices that are
  // farthest along the diagonals, seen from the front.
  const Positions points = patch.rows_of(mean);
  const int across = 3 - up.index - front.index;
  const auto along = [&](int axis, std::uint32_t v) {
    const double low = points.col(axis).minCoeff(), high = points.col(axis).maxCoeff();
    return (points(static_cast<Index>(v), axis) - low) / (high - low) - 0.5;
  };
  constexpr std::array<std::array<double, 2>, 4> kDiagonals = {
      {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto farthest = std::ranges::max_element(patch.border, {}, [&](std::uint32_t v) {
      return kDiagonals[i][0] * along(across, v) + kDiagonals[i][1] * along(up.index, v);
    });
    patch.corners_in_border[i] = static_cast<std::size_t>(farthest - patch.border.begin());
  }
  // Sort the corners in the order of the border.
  std::ranges::sort(patch.corners_in_border);
  return patch;
}

}  // namespace crowdface::multiscale
