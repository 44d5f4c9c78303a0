// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan.h"

#include <algorithm>
#include <numeric>

#include "crowdface/mesh/grouping.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Those that have exactly one triangle, ascending.
std::vector<Edge> rim_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges, rim;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next] == edges[i]) ++next;
    if (next - i == 1) rim.push_back(edges[i]);
  }
  return rim;
}

bool degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace

std::vector<bool> used_vertices(const Scan& scan) {
  std::vector<bool> used(static_cast<std::size_t>(scan.positions.rows()), false);
  for (const Triangle& t : scan.triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  return used;
}

std::vector<std::uint32_t> long_rims(const std::vector<Triangle>& triangles,
                                     const Positions& positions, double least_length) {
  const std::vector<Edge> edges = rim_edges(triangles);
  Grouping rims(static_cast<std::size_t>(positions.rows()));
  for (const auto& [a, b] : edges) rims.join(a, b);
  std::vector<double> length(static_cast<std::size_t>(positions.rows()), 0.0);
  for (const auto& [a, b] : edges) {
    length[rims.root(a)] += length3((positions.row(a) - positions.row(b)).transpose());
  }
  std::vector<std::uint32_t> vertices;
  for (const auto& [a, b] : edges) {
    if (length[rims.root(a)] >= least_length) vertices.insert(vertices.end(), {a, b});
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

Scan without_small_pieces(const Scan& scan, double least_share) {
  Grouping groups(static_cast<std::size_t>(scan.positions.rows()));
  for (const Triangle& t : scan.triangles) {
    groups.join(t[0], t[1]);
    groups.join(t[1], t[2]);
  }
  std::vector<double> area(static_cast<std::size_t>(scan.positions.rows()), 0.0);
  for (const Triangle& t : scan.triangles) {
    area[groups.root(t[0])] += length3(area_vector(scan.positions, t));
  }
  const double least = area.empty() ? 0 : least_share * *std::max_element(area.begin(), area.end());
  Scan kept{scan.positions, {}};
  for (const Triangle& t : scan.triangles) {
    if (!degenerate(t) && area[groups.root(t[0])] >= least) kept.triangles.push_back(t);
  }
  return kept;
}

void weld(Scan& scan) {
  std::vector<std::uint32_t> order(static_cast<std::size_t>(scan.positions.rows()));
  std::iota(order.begin(), order.end(), 0U);
  const auto place = [&](std::uint32_t v) {
    return std::array{scan.positions(v, 0), scan.positions(v, 1), scan.positions(v, 2)};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto x = place(a), y = place(b);
    return x < y || (x == y && a < b);
  });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    first[order[i]] =
        i > 0 && place(order[i]) == place(order[i - 1]) ? first[order[i - 1]] : order[i];
  }
  for (Triangle& t : scan.triangles) {
    for (std::uint32_t& v : t) v = first[v];
  }
}

}  // namespace crowdface
