// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The quantization grid of packed positions: a cube with 65,535 grid steps along each side.
struct PackingGrid {
  /// the cube's corner with the smallest coordinates
  Eigen::Vector3d low_corner = Eigen::Vector3d::Zero();
  double step = 1;  ///< length of a grid step, in the unit of the packed positions

  /// Returns a cube around all heads. On each side, the cube has a margin of a quarter of the
  /// heads' largest extent, because faces may extend beyond the heads.
  /// \param heads  positions of each head; all heads together must have at least one vertex.
  static PackingGrid enclosing(std::span<const Positions* const> heads);
};

/// Packs some vertices of a face as little-endian 16-bit numbers. The positions come first: three
/// numbers per vertex, in grid steps from the low corner of the grid. Positions outside the grid's
/// cube are clamped to the cube. The unit normals follow: two numbers per vertex, the octahedral
/// encoding (Meyer et al. 2010, "On floating-point normal vectors") with −1 … 1 mapped to 0 …
/// 65,535.
/// \param frame         the quantization grid.
/// \param vertices      the vertices to pack, as row indices of `positions`.
/// \param vertex_faces  the polygons around each vertex of the whole mesh. With the normals of the
///                      whole mesh, a reduced preview has the shading of the whole mesh.
std::string pack_face(const Topology& topology, std::span<const std::uint32_t> vertices,
                      const VertexFaces& vertex_faces, const PackingGrid& frame,
                      const Positions& positions);

/// Packs only positions, in the same format as the first part of the result of pack_face.
/// \param vertices  the vertices to pack, as row indices of `positions`.
std::string pack_points(std::span<const std::uint32_t> vertices, const PackingGrid& frame,
                        const Positions& positions);

/// Packs a displacement: three little-endian signed 16-bit numbers, in steps of the grid `frame`,
/// clamped to the range of 16 bits.
std::string pack_displacement(const Eigen::RowVector3d& move, const PackingGrid& frame);

/// Encodes bytes as base64 text (RFC 4648).
std::string base64(std::string_view bytes);

/// Returns the bytes of the numbers in little-endian order.
template <class Number>
std::string little_endian(const std::vector<Number>& numbers) {
  static_assert(std::endian::native == std::endian::little);
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

}  // namespace crowdface
