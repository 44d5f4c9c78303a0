// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/file_mesh.h"

#include <array>
#include <map>
#include <tuple>

namespace crowdface {
namespace {

/// Merges the copies of each split vertex.
void join_vertices(FileMesh& mesh) {
  const auto count = static_cast<std::size_t>(mesh.positions.rows());
  const bool has_ids = !mesh.vertex_ids.empty();
  std::vector<std::uint32_t> joined(count);  // index of the merged vertex for each vertex
  std::map<std::array<double, 4>, std::uint32_t> of_place;
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < count; ++v) {
    const auto row = mesh.positions.row(static_cast<Index>(v));
    const double piece = mesh.pieces.empty() ? 0 : mesh.pieces[v];
    const std::array<double, 4> key = {piece, has_ids ? mesh.vertex_ids[v] : row[0],
                                       has_ids ? 0 : row[1], has_ids ? 0 : row[2]};
    const auto [place, is_new] = of_place.try_emplace(key, next);
    if (is_new) {
      mesh.positions.row(next) = row;
      if (mesh.colours.rows() > 0) mesh.colours.row(next) = mesh.colours.row(static_cast<Index>(v));
      ++next;
    }
    joined[v] = place->second;
  }
  mesh.pieces.clear();
  mesh.vertex_ids.clear();
  if (next == count) return;
  mesh.positions.conservativeResize(next, 3);
  if (mesh.colours.rows() > 0) mesh.colours.conservativeResize(next, 3);
  for (std::uint32_t& vertex : mesh.topology.corner_vertices) vertex = joined[vertex];
  mesh.topology.vertex_count = next;
}

/// Merges equal texture coordinates at corners of the same vertex; unequal ones form a seam.
void join_uvs(FileMesh& mesh) {
  Topology& topology = mesh.topology;
  std::map<std::tuple<std::uint32_t, double, double>, std::uint32_t> rows;
  std::vector<double> uvs;
  for (std::size_t c = 0; c < topology.corner_uvs.size(); ++c) {
    std::uint32_t& row = topology.corner_uvs[c];
    if (row == kNoIndex) continue;
    const double u = mesh.uvs(row, 0), v = mesh.uvs(row, 1);
    const auto [place, is_new] = rows.try_emplace(std::tuple(topology.corner_vertices[c], u, v),
                                                  static_cast<std::uint32_t>(uvs.size() / 2));
    if (is_new) uvs.insert(uvs.end(), {u, v});
    row = place->second;
  }
  mesh.uvs =
      Eigen::Map<const TextureCoordinates>(uvs.data(), static_cast<Index>(uvs.size() / 2), 2);
}

}  // namespace

void set_rows(FileMesh& mesh, const std::vector<double>& points, const std::vector<double>& uvs,
              const std::vector<double>& colours) {
  const auto rows = static_cast<Index>(points.size() / 3);
  mesh.topology.vertex_count = rows;
  mesh.positions = Eigen::Map<const Positions>(points.data(), rows, 3);
  mesh.uvs =
      Eigen::Map<const TextureCoordinates>(uvs.data(), static_cast<Index>(uvs.size() / 2), 2);
  if (uvs.empty()) mesh.topology.corner_uvs.clear();
  if (!colours.empty()) mesh.colours = Eigen::Map<const Positions>(colours.data(), rows, 3);
}

void join_split_vertices(FileMesh& mesh) {
  if (mesh.pieces.empty() && mesh.vertex_ids.empty()) return;
  join_vertices(mesh);
  join_uvs(mesh);
}

}  // namespace crowdface
