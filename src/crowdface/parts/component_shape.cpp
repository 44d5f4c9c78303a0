// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/component_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {
namespace {

/// Largest number of a component's vertices whose distance from the skin is measured.
constexpr std::size_t kMaxProbes = 512;

/// Solves the symmetric 4 by 4 system A x = b by elimination with pivoting; returns zero if A is
/// singular.
std::array<double, 4> solve(std::array<std::array<double, 5>, 4> rows) {
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i) {
      if (std::abs(rows[i][k]) > std::abs(rows[pivot][k])) pivot = i;
    }
    if (rows[pivot][k] == 0) return {};
    std::swap(rows[k], rows[pivot]);
    for (std::size_t i = k + 1; i < 4; ++i) {
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < 5; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  std::array<double, 4> x{};
  for (std::size_t k = 4; k-- > 0;) {
    x[k] = rows[k][4];
    for (std::size_t j = k + 1; j < 4; ++j) x[k] -= rows[k][j] * x[j];
    x[k] /= rows[k][k];
  }
  return x;
}

/// Fits a sphere with centre c and radius r to the vertices p, by least squares on the linear
/// equations |p|² = 2 p·c + (r² − |c|²). All points are relative to the vertices' mean.
void fit_sphere(const Positions& positions, const std::vector<std::uint32_t>& vertices,
                ComponentShape& shape) {
  const Eigen::Vector3d middle = centre_of(positions, vertices);
  std::array<std::array<double, 5>, 4> rows{};
  for (const std::uint32_t v : vertices) {
    const std::array<double, 4> term = {2 * (positions(v, 0) - middle.x()),
                                        2 * (positions(v, 1) - middle.y()),
                                        2 * (positions(v, 2) - middle.z()), 1};
    const double square = (term[0] * term[0] + term[1] * term[1] + term[2] * term[2]) / 4;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) rows[i][j] += term[i] * term[j];
      rows[i][4] += term[i] * square;
    }
  }
  const std::array<double, 4> x = solve(rows);
  const Eigen::Vector3d centre(x[0], x[1], x[2]);
  shape.centre = middle + centre;
  shape.radius = std::sqrt(std::max(0.0, x[3] + centre.squaredNorm()));
}

/// Measures `roughness`: the distances of vertices and polygon centres from the fitted sphere.
/// Vertices alone do not suffice: the corners of any box lie on a sphere.
void measure_roughness(const Topology& topology, const Components& components,
                       const Positions& positions, std::vector<ComponentShape>& shapes) {
  std::vector<double> sums(shapes.size(), 0.0);
  const auto add = [&](std::size_t c, const Eigen::Vector3d& point) {
    const double off = (point - shapes[c].centre).norm() - shapes[c].radius;
    sums[c] += off * off;
  };
  for (Index v = 0; v < topology.vertex_count; ++v) {
    add(components.component_of_vertex[static_cast<std::size_t>(v)], positions.row(v).transpose());
  }
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t v : face) middle += positions.row(v).transpose();
    add(components.component_of_vertex[face[0]], middle / static_cast<double>(face.size()));
  }
  for (std::size_t c = 0; c < shapes.size(); ++c) {
    shapes[c].roughness =
        std::sqrt(sums[c] / static_cast<double>(shapes[c].vertex_count + shapes[c].polygon_count));
  }
}

/// Returns the 90th percentile of some vertices' distances from the skin. The vertices are chosen
/// evenly by index; a distance above `reach` counts as `reach`.
double distance_to(const PointGrid& skin, const Positions& positions,
                   const std::vector<std::uint32_t>& vertices, double reach) {
  std::vector<double> distances;
  for (const std::uint32_t vertex : evenly_spaced_items(vertices, kMaxProbes)) {
    distances.push_back(skin.nearest(positions.row(vertex).transpose(), reach).distance);
  }
  const std::size_t rank = (distances.size() - 1) * 9 / 10;
  return nth_smallest(std::move(distances), rank);
}

}  // namespace

std::vector<std::vector<std::uint32_t>> vertices_of_components(const Components& components) {
  std::vector<std::vector<std::uint32_t>> members(components.sizes.size());
  for (std::uint32_t v = 0; v < components.component_of_vertex.size(); ++v) {
    members[components.component_of_vertex[v]].push_back(v);
  }
  return members;
}

std::uint32_t index_in_list(std::span<const std::uint32_t> ascending, std::uint32_t vertex) {
  const auto at = std::ranges::lower_bound(ascending, vertex);
  if (at == ascending.end() || *at != vertex) return kNoIndex;
  return static_cast<std::uint32_t>(at - ascending.begin());
}

Eigen::AlignedBox3d bounding_box(const Positions& positions,
                                 std::span<const std::uint32_t> vertices) {
  Eigen::AlignedBox3d box;
  for (const std::uint32_t v : vertices) box.extend(row3(positions, v));
  return box;
}

Eigen::Vector3d centre_of(const Positions& positions, std::span<const std::uint32_t> vertices) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t v : vertices) sum += row3(positions, v);
  return sum / static_cast<double>(vertices.size());
}

double radius_about(const Eigen::Vector3d& middle, const Positions& positions,
                    std::span<const std::uint32_t> vertices) {
  double squares = 0;
  for (const std::uint32_t v : vertices) {
    const Eigen::Vector3d from = row3(positions, v) - middle;
    squares += from.squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(vertices.size()));
}

double extent_of(const Positions& positions, std::span<const std::uint32_t> vertices) {
  return bounding_box(positions, vertices).sizes().norm();
}

std::vector<ComponentShape> component_shapes(const Topology& topology, const Adjacency& adjacency,
                                             const Components& components,
                                             const Positions& positions) {
  const auto count = static_cast<std::size_t>(components.count());
  const std::vector<std::vector<std::uint32_t>> members = vertices_of_components(components);
  std::vector<ComponentShape> shapes(count);
  std::vector<double> area(count, 0.0), perimeter(count, 0.0);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    const std::size_t c = components.component_of_vertex[face[0]];
    ++shapes[c].polygon_count;
    area[c] += face_area_vector(topology, f, positions).norm() / 2;
  }
  // Count each edge between two boundary vertices as a boundary edge. A narrow strip also has such
  // edges across its middle, but even without these edges its isoperimetric ratio is large.
  for (Index i = 0; i < topology.vertex_count; ++i) {
    if (!adjacency.boundary[static_cast<std::size_t>(i)]) continue;
    for (const std::uint32_t n : adjacency.items_of(i)) {
      if (static_cast<Index>(n) < i || !adjacency.boundary[n]) continue;
      perimeter[components.component_of_vertex[n]] += (positions.row(i) - positions.row(n)).norm();
    }
  }
  for (std::size_t c = 0; c < count; ++c) {
    ComponentShape& shape = shapes[c];
    shape.vertex_count = static_cast<Index>(members[c].size());
    if (area[c] > 0)
      shape.isoperimetric_ratio = perimeter[c] * perimeter[c] / (4 * std::numbers::pi * area[c]);
    const Eigen::Vector3d sides = bounding_box(positions, members[c]).sizes();
    shape.extent = sides.norm();
    shape.thickness = sides.minCoeff();
  }
  const std::uint32_t skin = components.largest();
  const PointGrid skin_grid(positions, members[skin]);
  for (std::size_t c = 0; c < count; ++c) {
    throw_if_interrupted();
    if (c == skin || shapes[c].polygon_count == 0) continue;
    fit_sphere(positions, members[c], shapes[c]);
    shapes[c].skin_distance =
        distance_to(skin_grid, positions, members[c], kFarFromSkin * shapes[skin].extent);
  }
  measure_roughness(topology, components, positions, shapes);
  return shapes;
}

}  // namespace crowdface
