// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/outward_polygons.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {

namespace {

constexpr double kFarthest = 1e9;  // largest coordinate; the same limit as for landmarks

bool has_area(const Scan& scan) {
  return std::ranges::any_of(scan.triangles, [&](const Triangle& triangle) {
    return area_vector(scan.positions, triangle).norm() > 0;
  });
}

/// The smallest difference between two unequal coordinates along one axis, in a sample of the
/// vertices. If the coordinates have enough digits, this difference is far smaller than the scan.
/// \param values  coordinates of all vertices along the axis. \return 0 if there are few vertices.
double smallest_step(const std::vector<double>& values) {
  constexpr std::size_t kMinValues = 500, kSample = 2000;
  if (values.size() < kMinValues) return 0;
  std::vector<double> sample;
  const std::size_t stride = std::max<std::size_t>(1, values.size() / kSample);
  for (std::size_t i = 0; i < values.size(); i += stride) sample.push_back(values[i]);
  std::ranges::sort(sample);
  sample.erase(std::unique(sample.begin(), sample.end()), sample.end());
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < sample.size(); ++i) step = std::min(step, sample[i] - sample[i - 1]);
  return step;
}

/// Rejects scans whose coordinates are too coarse: scans far from the origin (for example in map
/// coordinates) that have single precision or few digits. Their surface would consist of steps.
void refuse_coarse_numbers(const Scan& scan, const std::filesystem::path& path) {
  constexpr double kFar = 10, kMaxOfSize = 5e-3, kMaxSingleOfSize = 1e-3;
  const std::vector<bool> used = is_vertex_used(scan);
  std::array<std::vector<double>, 3> values;
  Eigen::AlignedBox3d box;
  bool are_singles = true;
  for (Index v = 0; v < scan.positions.rows(); ++v) {
    if (!used[static_cast<std::size_t>(v)]) continue;
    const Eigen::Vector3d place = row3(scan.positions, v);
    are_singles = are_singles && place.cast<float>().cast<double>() == place;
    box.extend(place);
    for (std::size_t k = 0; k < 3; ++k) values[k].push_back(place[static_cast<Index>(k)]);
  }
  const double size = box.diagonal().norm();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Index>(k);
    const double farthest = std::max(std::abs(box.min()[axis]), std::abs(box.max()[axis]));
    const double of_singles =
        are_singles && farthest > 0 ? std::ldexp(1.0, std::ilogb(farthest) - 23) : 0;
    const bool is_single = of_singles > kMaxSingleOfSize * size;
    const double step = is_single ? of_singles : smallest_step(values[k]);
    if (!is_single && !(farthest > kFar * size && step > kMaxOfSize * size)) continue;
    refuse_file(path, concat("its ", "xyz"[k], " coordinates near ", format_fixed(farthest, 0),
                             is_single ? " in single precision" : "",
                             std::isinf(step) ? " are all equal"
                                              : concat(" have steps of ", format_fixed(step, 3)),
                             ", too coarse for a scan of size ", format_fixed(size, 1),
                             ": move the scan near the origin before exporting it, or export ",
                             is_single ? "doubles (PLY, OBJ)" : "more digits"));
  }
}

/// Rejects a large scan in which at least half of the triangles share one vertex, because the
/// bounding boxes of these triangles overlap at the vertex and make the spatial search slow.
void refuse_fan(const Scan& scan, const std::filesystem::path& path) {
  constexpr std::uint32_t kManyTriangles = 4096;
  std::vector<std::uint32_t> triangles_at(static_cast<std::size_t>(scan.positions.rows()), 0);
  for (const Triangle& triangle : scan.triangles) {
    for (const std::uint32_t vertex : triangle) ++triangles_at[vertex];
  }
  const auto most = std::max_element(triangles_at.begin(), triangles_at.end());
  if (*most < kManyTriangles || *most < scan.triangles.size() / 2) return;
  const Eigen::Vector3d at = row3(scan.positions, most - triangles_at.begin());
  refuse_file(path,
              concat("expected a scanned surface, found ", *most, " of its ", scan.triangles.size(),
                     " triangles at one vertex, at (", at.x(), ", ", at.y(), ", ", at.z(), ")"));
}

/// Handles vertices with positions that are not finite: removes the triangles that use such
/// vertices, and moves the vertices to the position of another vertex.
void remove_non_finite_positions(Scan& scan) {
  const auto is_placed = [&](std::uint32_t v) { return scan.positions.row(v).allFinite(); };
  if (scan.positions.allFinite()) return;
  keep_triangles(scan,
                 [&](std::size_t i) { return std::ranges::all_of(scan.triangles[i], is_placed); });
  if (scan.triangles.empty()) return;
  for (std::uint32_t v = 0; v < scan.positions.rows(); ++v) {
    if (!is_placed(v)) scan.positions.row(v) = scan.positions.row(scan.triangles[0][0]);
  }
}

}  // namespace

Scan read_scan(const std::filesystem::path& path) {
  FileMesh mesh = read_mesh(path);
  return scan_of(mesh, path);
}

Scan scan_of(FileMesh& mesh, const std::filesystem::path& path) {
  reverse_inward_faces(mesh);
  Scan scan{std::move(mesh.positions), triangles_of(mesh.topology), std::move(mesh.notes)};
  scan.file_triangle_indices.resize(scan.triangles.size());
  std::iota(scan.file_triangle_indices.begin(), scan.file_triangle_indices.end(), 0U);
  remove_non_finite_positions(scan);
  if (scan.triangles.empty()) {
    refuse_file(path, concat("expected a surface of triangles, found ", scan.positions.rows(),
                             " points and no face: build a mesh of them first (MeshLab: Surface "
                             "Reconstruction; Metashape: Build Model)"));
  }
  if (!(scan.positions.array().abs() <= kFarthest).all()) {
    refuse_file(path, concat("expected positions that are not farther than ", kFarthest,
                             " from the origin, found a farther one: move the scan near the origin "
                             "before exporting it"));
  }
  refuse_coarse_numbers(scan, path);
  if (!has_area(scan))
    refuse_file(path,
                "expected a surface, found only triangles without area: export the scan again");
  weld_vertices(scan);
  refuse_fan(scan, path);
  return remove_covering_layers(scan);
}

}  // namespace crowdface
