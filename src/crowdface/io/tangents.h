// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "crowdface/io/split_vertices.h"

namespace crowdface {

/// Like split_vertices, but a polygon with mirrored texture coordinates shares no split vertex with
/// a polygon whose texture coordinates are not mirrored.
SplitVertices split_at_mirrored_uvs(const Topology& topology, const TextureCoordinates& uvs);

/// Tangents for normal mapping, by the rules of MikkTSpace (Mikkelsen 2008, "Simulation of wrinkled
/// surfaces revisited"). A vertex tangent is the mean of the directions in which u grows on the
/// triangles at the vertex. The weight of a triangle is its angle at the vertex, projected onto the
/// plane of the vertex normal.
class Tangents {
 public:
  static constexpr std::size_t kSize = 4 * sizeof(float);  ///< number of bytes of a tangent

  /// \param split  result of split_at_mirrored_uvs.
  /// \param uvs    #T by 2, v upwards as in OBJ.
  Tangents(const SplitVertices& split, const TextureCoordinates& uvs);

  /// Writes four numbers per split vertex, as in glTF's attribute TANGENT: the three components of
  /// the unit tangent, and a sign: −1 where the texture coordinates are mirrored, else 1.
  /// \param positions, normals  #V by 3.
  void write(char* out, const Positions& positions, const Positions& normals) const;

  /// Number of split vertices.
  std::size_t count() const { return vertices_.size(); }
  /// Memory used by this object, in bytes.
  std::size_t memory_bytes() const;

 private:
  /// A triangle with the data that its texture coordinates determine.
  struct UvTriangle {
    std::array<std::uint32_t, 3> corners;  ///< indices of split vertices
    /// The sum of the edges from corner 0 to the corners 1 and 2, weighted by these numbers, is the
    /// direction in which u grows.
    double first_edge_weight, second_edge_weight;
  };
  std::vector<std::uint32_t> vertices_;  ///< the original vertex of each split vertex
  /// for each split vertex: −1 if its texture coordinates are mirrored, else 1
  std::vector<float> signs_;
  /// the triangles whose area in texture coordinates is not zero
  std::vector<UvTriangle> triangles_;
};

}  // namespace crowdface
