// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/file_mesh.h"

#include <map>
#include <tuple>
#include <utility>

#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/joined_borders.h"

namespace crowdface {
namespace {

/// Joins the vertices that have the same id and lie in the same mesh of the file.
JoinedBorders joined_ids(const FileMesh& mesh) {
  JoinedBorders result;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> of_id;
  for (std::uint32_t v = 0; v < mesh.vertex_ids.size(); ++v) {
    const std::uint32_t piece = mesh.mesh_of_vertex.empty() ? 0 : mesh.mesh_of_vertex[v];
    const auto [place, is_new] =
        of_id.try_emplace({piece, mesh.vertex_ids[v]},
                          static_cast<std::uint32_t>(result.first_copy_of_joined_vertex.size()));
    if (is_new) result.first_copy_of_joined_vertex.push_back(v);
    result.joined_vertex_of_vertex.push_back(place->second);
  }
  return result;
}

/// Merges the copies of each vertex that the format has split.
void join_vertices(FileMesh& mesh) {
  const JoinedBorders by = mesh.vertex_ids.empty()
                               ? joined_borders(mesh.topology, mesh.positions, mesh.mesh_of_vertex)
                               : joined_ids(mesh);
  mesh.mesh_of_vertex.clear();
  mesh.vertex_ids.clear();
  mesh.positions = Positions(mesh.positions(by.first_copy_of_joined_vertex, kAllColumns));
  if (mesh.colours.rows() > 0)
    mesh.colours = Positions(mesh.colours(by.first_copy_of_joined_vertex, kAllColumns));
  for (std::uint32_t& vertex : mesh.topology.corner_vertices)
    vertex = by.joined_vertex_of_vertex[vertex];
  mesh.topology.vertex_count = mesh.positions.rows();
}

/// Merges equal texture coordinates of corners of the same vertex. At a seam, the texture
/// coordinates of the corners differ.
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

void set_vertex_data(FileMesh& mesh, const std::vector<double>& points,
                     const std::vector<double>& uvs, const std::vector<double>& colours) {
  const auto rows = static_cast<Index>(points.size() / 3);
  mesh.topology.vertex_count = rows;
  mesh.positions = Eigen::Map<const Positions>(points.data(), rows, 3);
  mesh.uvs =
      Eigen::Map<const TextureCoordinates>(uvs.data(), static_cast<Index>(uvs.size() / 2), 2);
  if (uvs.empty()) mesh.topology.corner_uvs.clear();
  if (!colours.empty()) mesh.colours = Eigen::Map<const Positions>(colours.data(), rows, 3);
}

bool join_split_vertices(FileMesh& mesh) {
  if (mesh.mesh_of_vertex.empty() && mesh.vertex_ids.empty()) return false;
  const Index split = mesh.positions.rows();
  join_vertices(mesh);
  join_uvs(mesh);
  if (mesh.positions.rows() == split) return false;
  mesh.notes.emplace_back("vertices that the export split at seams are joined again");
  return true;
}

}  // namespace crowdface
