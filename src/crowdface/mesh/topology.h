// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "crowdface/core/grouped.h"

namespace crowdface {

using Eigen::Index;

/// #V by 3 vertex positions, one row a vertex, in the unit of the mesh's file.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// Positions or displacements in single precision, one a row.
using SingleRows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// #T by 2 texture coordinates.
using TextureCoordinates = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// Marks a corner that has no texture coordinate.
inline constexpr std::uint32_t kNoIndex = 0xffffffffU;

/// Which vertices form which faces: triangles, quads and larger polygons, as corners and offsets.
/// Face f owns the corners [face_offsets[f], face_offsets[f + 1]).
struct Topology {
  Index vertex_count = 0;
  std::vector<std::uint32_t> corner_vertices;     ///< #C, each < vertex_count
  std::vector<std::uint32_t> corner_uvs;          ///< #C rows of the UVs or kNoIndex; or empty
  std::vector<std::uint32_t> face_offsets = {0};  ///< #F + 1, ascending

  Index face_count() const { return static_cast<Index>(face_offsets.size()) - 1; }
  Index corner_count() const { return static_cast<Index>(corner_vertices.size()); }
  void add_face(std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> uvs = {});
  /// The vertices of face f in order.
  std::span<const std::uint32_t> face(Index f) const {
    const auto [begin, end] = corners(f);
    return {corner_vertices.data() + begin, end - begin};
  }
  /// Its rows of the UVs; empty if there are none.
  std::span<const std::uint32_t> face_uvs(Index f) const {
    const auto [begin, end] = corners(f);
    if (corner_uvs.empty()) return {};
    return {corner_uvs.data() + begin, end - begin};
  }
  /// Its first corner, and the first of the next face.
  std::pair<std::uint32_t, std::uint32_t> corners(Index f) const {
    return {face_offsets[static_cast<std::size_t>(f)],
            face_offsets[static_cast<std::size_t>(f) + 1]};
  }
};

/// The faces that meet at each vertex, ascending.
struct FacesAround : Grouped<std::uint32_t> {
  explicit FacesAround(const Topology& topology);
};

/// A mesh by itself: what a generator makes and a writer writes.
struct Mesh {
  Topology topology;
  Positions positions;     ///< #V by 3
  TextureCoordinates uvs;  ///< #T by 2, may be empty
};

struct Head {
  std::string name;     ///< unique in its set: the file's name without its ending
  Positions positions;  ///< #V by 3
};

/// Heads in one topology, with shared texture coordinates.
struct FaceSet {
  Topology topology;
  TextureCoordinates uvs;
  std::vector<Head> heads;
};

/// Numbers what is used anew, in ascending order. \return the old number of each.
/// \param indices  each < count; become the new numbers.
std::vector<std::uint32_t> renumber(std::span<std::uint32_t> indices, Index count);

/// The mean of all heads, #V by 3.
Positions mean_head(const FaceSet& faces);

/// The first difference between two topologies as a sentence ("face 12: expected vertices 1 2 3 4,
/// found 1 2 4 3"; faces and vertices counted from 1 as in OBJ), or an empty text if there is none.
std::string first_difference(const Topology& expected, const Topology& found);

}  // namespace crowdface
