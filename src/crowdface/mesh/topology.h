// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "crowdface/core/compressed_rows.h"

namespace crowdface {

using Eigen::Index;

/// Vertex positions, #V by 3, in the unit of the mesh's file.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// Positions or displacements in single precision, #rows by 3.
using FloatPositions = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Texture coordinates, #T by 2.
using TextureCoordinates = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// Stands for a missing index, for example of a corner without a texture coordinate.
inline constexpr std::uint32_t kNoIndex = 0xffffffffU;

/// The polygons of a mesh: triangles, quads and larger polygons, stored as corners and offsets.
/// Polygon f owns the corners [face_offsets[f], face_offsets[f + 1]).
struct Topology {
  Index vertex_count = 0;
  std::vector<std::uint32_t> corner_vertices;  ///< #C: the vertex of each corner
  /// #C: row of each corner's texture coordinate, or kNoIndex; empty if the mesh has no texture
  /// coordinates
  std::vector<std::uint32_t> corner_uvs;
  std::vector<std::uint32_t> face_offsets = {0};  ///< #F + 1: first corner of each polygon

  /// Number of polygons.
  Index face_count() const { return static_cast<Index>(face_offsets.size()) - 1; }
  /// Number of corners of all polygons together.
  Index corner_count() const { return static_cast<Index>(corner_vertices.size()); }
  /// Adds a polygon at the end. \param uvs  rows of the corners' texture coordinates; or empty
  void add_face(std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> uvs = {});
  /// The vertices of polygon f in order.
  std::span<const std::uint32_t> face(Index f) const {
    const auto [begin, end] = corners(f);
    return {corner_vertices.data() + begin, end - begin};
  }
  /// For each corner of polygon f, the row of its texture coordinate; empty if the mesh has no
  /// texture coordinates.
  std::span<const std::uint32_t> face_uvs(Index f) const {
    const auto [begin, end] = corners(f);
    if (corner_uvs.empty()) return {};
    return {corner_uvs.data() + begin, end - begin};
  }
  /// The first corner of polygon f, and the first corner of the next polygon.
  std::pair<std::uint32_t, std::uint32_t> corners(Index f) const {
    return {face_offsets[static_cast<std::size_t>(f)],
            face_offsets[static_cast<std::size_t>(f) + 1]};
  }
};

/// The polygons that meet at each vertex, ascending.
struct VertexFaces : CompressedRows<std::uint32_t> {
  explicit VertexFaces(const Topology& topology);
};

/// A complete mesh: topology, positions and texture coordinates.
struct Mesh {
  Topology topology;
  Positions positions;     ///< #V by 3
  TextureCoordinates uvs;  ///< texture coordinates, #T by 2; may be empty
};

/// A head of a HeadSet, which holds the topology of all its heads.
struct Head {
  std::string name;     ///< file name without extension; unique in the HeadSet
  Positions positions;  ///< #V by 3
};

/// Heads that share one topology and the same texture coordinates.
struct HeadSet {
  Topology topology;
  TextureCoordinates uvs;
  std::vector<Head> heads;
};

/// Renumbers indices without gaps: the smallest value in `indices` becomes 0, the next larger value
/// becomes 1, and so on.
/// \param indices  each below `count`; the function writes the new numbers here.
/// \return the old number of each new number.
std::vector<std::uint32_t> renumber(std::span<std::uint32_t> indices, Index count);

/// The mean of all heads, #V by 3.
Positions mean_head(const HeadSet& head_set);

/// Describes the first difference between two topologies in words ("face 12: expected vertices 1 2
/// 3 4, found 1 2 4 3"). Counts polygons and vertices from 1, as OBJ does. Returns an empty text if
/// the topologies are equal.
std::string first_difference(const Topology& expected, const Topology& found);

}  // namespace crowdface
