// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/preview/split_mesh.h"

namespace crowdface {

/// A reduced mesh in the layout that a graphics card needs: vertices at texture seams and at
/// borders between materials are split into several copies.
struct PreviewMesh {
  /// for each preview vertex: index of the vertex in the whole mesh
  std::vector<std::uint32_t> vertices;
  /// For each preview vertex: index of the first preview vertex that is a copy of the same vertex
  /// of the whole mesh. Copies share a normal, so that borders do not show.
  std::vector<std::uint32_t> first_copy_of_vertex;
  /// Indices into `vertices`, three per triangle, grouped by material.
  std::vector<std::uint32_t> triangles;
  std::vector<float> uvs;  ///< u and v of each preview vertex; empty without texture coordinates
  /// for each preview vertex: a polygon of the whole mesh that uses this vertex
  std::vector<std::uint32_t> face_of_vertex;
  /// for each material that has triangles: the index of its first triangle
  std::vector<std::uint32_t> material_starts;
};

/// Builds a reduced mesh. Treats the polygons of each texture tile as one material.
/// \param uvs  texture coordinates; polygons need not have any.
/// \param typical_positions  #V by 3: vertex positions with which the error of edge collapses is
///                           measured.
/// \param is_shown  for each polygon: whether the preview shows the polygon; empty: shows all
///                  polygons.
/// \param max_vertices  approximate maximum number of vertices, counted before vertices are split.
PreviewMesh preview_mesh(const Topology& topology, const TextureCoordinates& uvs,
                         const Positions& typical_positions, const std::vector<bool>& is_shown,
                         std::size_t max_vertices);

/// Builds the preview mesh from triangles that are already reduced.
/// \param triangles  indices of corners of `split`.
/// \param uvs        the texture coordinates from which `split` was made.
PreviewMesh preview_from_split_mesh(const SplitMesh& split, std::vector<Triangle> triangles,
                                    const TextureCoordinates& uvs);

/// Maximum number of triangles of skin in draft meshes (see draft_triangles).
inline constexpr std::size_t kMaxDraftTriangles = 8'000;

/// Returns the triangles of a coarser mesh that uses some of the vertices of a preview mesh:
/// triples of indices into `mesh.vertices`. Pages that draw without a graphics card show this draft
/// mesh while the view or the face moves.
/// \param typical_positions  positions of all vertices of the whole mesh, #V by 3.
/// \param max_triangles  approximate maximum number of triangles.
std::vector<std::uint32_t> draft_triangles(const PreviewMesh& mesh,
                                           const Positions& typical_positions,
                                           std::size_t max_triangles);

}  // namespace crowdface
