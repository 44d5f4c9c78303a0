// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "crowdface/mesh/disjoint_sets.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/part_list.h"

namespace crowdface {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The boundary edges (edges of exactly one triangle), ascending.
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

/// For each triangle, twice the area of the connected component to which the triangle belongs.
std::vector<double> areas_of_pieces(const Scan& scan) {
  DisjointSets groups(static_cast<std::size_t>(scan.positions.rows()));
  for (const Triangle& t : scan.triangles) {
    groups.join(t[0], t[1]);
    groups.join(t[1], t[2]);
  }
  std::vector<double> of_group(static_cast<std::size_t>(scan.positions.rows()), 0.0), areas;
  for (const Triangle& t : scan.triangles) {
    of_group[groups.root(t[0])] += area_vector(scan.positions, t).norm();
  }
  for (const Triangle& t : scan.triangles) areas.push_back(of_group[groups.root(t[0])]);
  return areas;
}

double largest(const std::vector<double>& areas) {
  return areas.empty() ? 0 : std::ranges::max(areas);
}

/// If the scan has eyeballs (a modelled head), keeps only the components whose class `is_wanted`
/// accepts; otherwise returns the scan unchanged.
Scan keep_part_classes(const Scan& scan, const std::function<bool(PartClass)>& is_wanted) {
  const Topology topology = topology_of(scan.triangles, scan.positions.rows());
  const Adjacency adjacency = build_adjacency(topology);
  const Components components = find_components(adjacency);
  const PartList parts = find_parts(topology, adjacency, components, scan.positions);
  if (std::ranges::none_of(parts.parts, [](const Part& part) { return part.is_eyeball; }))
    return scan;
  Scan kept = scan;
  keep_triangles(kept, [&](std::size_t i) {
    return is_wanted(parts.classes[components.component_of_vertex[scan.triangles[i][0]]]);
  });
  return kept;
}

}  // namespace

void keep_triangles(Scan& scan, const std::function<bool(std::size_t)>& is_kept) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scan.triangles.size(); ++i) {
    if (!is_kept(i)) continue;
    scan.triangles[kept] = scan.triangles[i];
    if (!scan.file_triangle_indices.empty())
      scan.file_triangle_indices[kept] = scan.file_triangle_indices[i];
    ++kept;
  }
  scan.triangles.resize(kept);
  if (!scan.file_triangle_indices.empty()) scan.file_triangle_indices.resize(kept);
}

std::vector<bool> is_vertex_used(const Scan& scan) {
  std::vector<bool> used(static_cast<std::size_t>(scan.positions.rows()), false);
  for (const Triangle& t : scan.triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  return used;
}

double net_area_fraction(const Scan& scan) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (const Triangle& triangle : scan.triangles) {
    const Eigen::Vector3d vector = area_vector(scan.positions, triangle);
    sum += vector;
    area += vector.norm();
  }
  return area > 0 ? sum.norm() / area : 0;
}

std::vector<std::uint32_t> long_boundaries(const std::vector<Triangle>& triangles,
                                           const Positions& positions, double min_length) {
  const std::vector<Edge> edges = rim_edges(triangles);
  DisjointSets rims(static_cast<std::size_t>(positions.rows()));
  for (const auto& [a, b] : edges) rims.join(a, b);
  std::vector<double> length(static_cast<std::size_t>(positions.rows()), 0.0);
  for (const auto& [a, b] : edges) {
    length[rims.root(a)] += (row3(positions, a) - row3(positions, b)).norm();
  }
  std::vector<std::uint32_t> vertices;
  for (const auto& [a, b] : edges) {
    if (length[rims.root(a)] >= min_length) vertices.insert(vertices.end(), {a, b});
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

Scan remove_small_pieces(const Scan& scan, double min_share) {
  const std::vector<double> areas = areas_of_pieces(scan);
  const double least = min_share * largest(areas);
  Scan kept = scan;
  keep_triangles(
      kept, [&](std::size_t i) { return !degenerate(scan.triangles[i]) && areas[i] >= least; });
  return kept;
}

Scan remove_covering_layers(const Scan& scan) {
  return keep_part_classes(scan, [](PartClass of) { return of != PartClass::kBound; });
}

Scan keep_skin(const Scan& scan) {
  return keep_part_classes(scan, [](PartClass of) { return of == PartClass::kSkin; });
}

void weld_vertices(Scan& scan) {
  std::vector<std::uint32_t> order(static_cast<std::size_t>(scan.positions.rows()));
  std::iota(order.begin(), order.end(), 0U);
  const auto place = [&](std::uint32_t v) {
    return std::array{scan.positions(v, 0), scan.positions(v, 1), scan.positions(v, 2)};
  };
  std::ranges::stable_sort(order, {}, place);
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    first[order[i]] =
        i > 0 && place(order[i]) == place(order[i - 1]) ? first[order[i - 1]] : order[i];
  }
  Scan welded = scan;
  for (Triangle& t : welded.triangles) {
    for (std::uint32_t& v : t) v = first[v];
  }
  constexpr double kGrows = 1.1;
  if (largest(areas_of_pieces(welded)) <= kGrows * largest(areas_of_pieces(scan))) return;
  scan = std::move(welded);
}

}  // namespace crowdface
