// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/preview/split_mesh.h"

namespace crowdface {

/// A reduced mesh for a graphics card: vertices are split at texture seams and at borders between
/// materials.
struct PreviewMesh {
  std::vector<std::uint32_t> vertices;  ///< vertices of the whole mesh
  /// #vertices: the first index in `vertices` with the same vertex of the whole mesh.
  std::vector<std::uint32_t> first_copies;
  /// Indices into `vertices`, three per triangle, grouped by material.
  std::vector<std::uint32_t> triangles;
  std::vector<float> uvs;            ///< two per vertex; empty if there are no texture coordinates
  std::vector<std::uint32_t> faces;  ///< #vertices: a face of the whole mesh with this corner
  std::vector<std::uint32_t> material_starts;  ///< first triangle of each material with triangles
};

/// Builds a reduced mesh; each texture tile counts as a material.
/// \param uvs            rows of texture coordinates, for the faces that have any.
/// \param typical        #V by 3: positions for measuring the error of edge collapses.
/// \param shown          #F: whether the preview shows each face; empty: all.
/// \param max_vertices  approximate largest number of vertices before splitting.
PreviewMesh preview_mesh(const Topology& topology, const TextureCoordinates& uvs,
                         const Positions& typical, const std::vector<bool>& shown,
                         std::size_t max_vertices);

/// Builds the preview mesh from triangles that are already reduced.
/// \param triangles  indices of corners of `split`.
/// \param uvs        the texture coordinates that `split` was made with.
PreviewMesh preview_from_split_mesh(const SplitMesh& split, std::vector<Triangle> triangles,
                                    const TextureCoordinates& uvs);

/// Largest number of triangles of the skin in draft meshes (see draft_triangles).
inline constexpr std::size_t kMaxDraftTriangles = 12'000;

/// Returns a coarser mesh over the vertices of a preview mesh, for pages that draw without a
/// graphics card while something moves: triples of indices into `mesh.vertices`.
/// \param typical        #V of the whole mesh by 3.
/// \param max_triangles  approximate largest number of triangles.
std::vector<std::uint32_t> draft_triangles(const PreviewMesh& mesh, const Positions& typical,
                                           std::size_t max_triangles);

}  // namespace crowdface
