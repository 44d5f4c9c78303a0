// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// Attaches the vertices of bound parts to the skin. Each bound vertex is anchored to a point on
/// the nearest triangle of the skin. The vertex keeps its offset from this point in a coordinate
/// frame that rotates with the skin around the triangle. Two axes of the frame are weighted sums of
/// the surrounding vertices' positions with fixed weights, made orthonormal.
class Anchors {
 public:
  Anchors() = default;
  /// \param positions  The head on which the nearest skin is found.
  /// \param skin       Grid of the skin's vertices at these positions.
  /// \param vertices_to_bind  Vertices of bound parts, ascending.
  Anchors(const Topology& topology, const VertexFaces& faces, const Positions& positions,
          const PointGrid& skin, std::vector<std::uint32_t> vertices_to_bind);

  /// Measures, for each bound vertex of a head, the offset of the vertex from its anchor point on
  /// the skin, in the coordinate frame that rotates with this skin.
  std::vector<Eigen::Vector3d> measure_offsets(const Positions& head) const;
  /// Places the bound vertices of a blended head on its skin: each vertex at its offset, in the
  /// coordinate frame that the skin of `result` gives the vertex. If the skin around a vertex has
  /// the same positions in `result` as in `target`, the vertex gets exactly its position in
  /// `target`.
  ///
  /// \param offsets  One offset per bound vertex, measured on the target.
  /// \param result   The blended head, #V by 3; the positions of the bound vertices are changed.
  void place_vertices(const Positions& target, std::span<const Eigen::Vector3d> offsets,
                      Positions& result) const;

 private:
  using Frame = std::array<Eigen::Vector3d, 3>;  ///< a coordinate frame: three orthonormal axes
  /// A vertex of the ring of skin vertices around a triangle, from which the triangle's coordinate
  /// frame is computed.
  struct RingVertex {
    std::uint32_t vertex;
    /// weights of the vertex in the sums for the frame's first and second axis
    double first_axis_weight, second_axis_weight;
  };

  /// Returns the coordinate frame at the triangle `skin_triangles_[triangle_index]`.
  Frame frame_at(std::size_t triangle_index, const Positions& positions) const;
  /// Returns the anchor point of the bound vertex `bound_vertices_[i]`.
  Eigen::Vector3d origin(std::size_t i, const Positions& positions) const;
  /// Returns whether the skin around a triangle has the same positions in `before` and `after`.
  bool is_unmoved(std::size_t triangle_index, const Positions& before,
                  const Positions& after) const;

  /// indices of the bound vertices in the mesh, ascending
  std::vector<std::uint32_t> bound_vertices_;
  /// per bound vertex: the skin triangle of its anchor, as an index into `skin_triangles_`
  std::vector<std::uint32_t> triangle_indices_;
  /// per bound vertex: barycentric coordinates of its anchor
  std::vector<std::array<double, 3>> barycentric_;
  std::vector<Triangle> skin_triangles_;  ///< the triangles of the skin to which vertices are bound
  /// for each of `skin_triangles_`: the skin vertices around it, with weights
  CompressedRows<RingVertex> rings_;
};

/// The weights with which bound vertices follow the motions of nearby rigid parts. For example,
/// gums follow teeth.
class PartWeights {
 public:
  PartWeights() = default;
  /// \param positions  The head on which distances are measured.
  /// \param rigid      Vertices of each rigid part.
  /// \param bound      Vertices that may follow a part.
  /// \param reach      Vertices farther than this distance from a part do not follow the part.
  ///                   Nearer vertices follow the part more; a vertex at distance 0 follows the
  ///                   part completely.
  PartWeights(const Positions& positions, const std::vector<std::span<const std::uint32_t>>& rigid,
              std::span<const std::uint32_t> bound, double reach);

  /// Moves each vertex of `result` that follows rigid parts. The new position is the weighted mean
  /// of the vertex's position in `result` and its positions after the motions of these parts.
  ///
  /// \param target   The head that the face is built on.
  /// \param motions  Motion of each rigid part, from `target` to the face.
  void move_with_parts(const Positions& target, std::span<const RigidMotion> motions,
                       Positions& result) const;

 private:
  /// The weight of a rigid part's motion at a bound vertex.
  struct PartWeight {
    std::uint32_t vertex, part;  ///< a bound vertex, and the index of a rigid part
    /// weight of the part's motion at the vertex; the weights of a vertex sum to at most one
    double weight;
  };
  std::vector<PartWeight> weights_;  ///< all weights; the weights of one vertex are consecutive
};

}  // namespace crowdface
