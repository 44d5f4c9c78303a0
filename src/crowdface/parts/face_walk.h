// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A directed edge, in the winding order of a polygon.
struct DirectedEdge {
  std::uint32_t from, to;
};

/// A vertex and its mirror partner.
struct MirroredPair {
  std::uint32_t vertex, partner;
};

/// Finds mirror partners by walking over the two sides of a mesh simultaneously. The constructor
/// allocates the work arrays, so each thread needs its own object.
class MirroredWalk {
 public:
  /// \param topology  Must outlive this object.
  /// \param vertex_faces  Must outlive this object.
  MirroredWalk(const Topology& topology, const VertexFaces& vertex_faces);

  /// Walks from polygon to polygon on both sides simultaneously; on the second side, corners are
  /// visited in the opposite order. The walk succeeds if corresponding polygons have equally many
  /// corners and if no vertex gets two different partners.
  ///
  /// \param edge     An edge of a polygon on the first side.
  /// \param other    The mirror image of `edge` on the second side: from the partner of edge.to to
  ///                 the partner of edge.from.
  /// \param may_continue  Called once for each new pair. If the function returns false, the walk
  ///                      ends without result.
  /// \return         All pairs found, or nothing if the two sides do not match.
  std::optional<std::vector<MirroredPair>> walk_from(
      DirectedEdge edge, DirectedEdge other,
      const std::function<bool(const MirroredPair&)>& may_continue);

 private:
  /// An edge of a polygon: the polygon, and the corner where the edge begins.
  struct FaceEdge {
    std::uint32_t face;
    std::size_t corner;
  };
  /// Corresponding edges of two mirrored polygons: `here` on the first side, `there` on the second
  /// side.
  struct FaceEdgePair {
    FaceEdge here, there;  ///< on the first side, and on the second side
  };

  /// Returns the polygon that contains the directed edge, and the corner where the edge begins;
  /// nothing if no polygon contains the edge.
  std::optional<FaceEdge> face_along(DirectedEdge edge) const;
  /// Visits two mirrored polygons: the polygon with the directed edge `here`, and the polygon with
  /// the corresponding edge `there`.
  /// \return false if only one of the edges has a polygon.
  bool visit_faces(DirectedEdge here, DirectedEdge there);
  /// Records a pair of mirror partners.
  /// \return false if either vertex already has another partner.
  bool add_pair(MirroredPair pair);
  /// Pairs the corners of two mirrored polygons. Returns false if the polygons do not match, or if
  /// `may_continue` returns false.
  bool pair_corners(const FaceEdgePair& faces,
                    const std::function<bool(const MirroredPair&)>& may_continue);
  /// Fills `pairs_` as walk_from describes; returns false if the walk fails.
  bool walk(DirectedEdge edge, DirectedEdge other,
            const std::function<bool(const MirroredPair&)>& may_continue);
  /// Clears the results of the walk.
  void reset();

  const Topology& topology_;
  const VertexFaces& vertex_faces_;
  /// for each vertex of the first side: the mirror partner that the current walk found on the
  /// second side; kNoIndex if none
  std::vector<std::uint32_t> partner_of_vertex_;
  /// for each vertex of the second side: its mirror partner on the first side; kNoIndex if none
  std::vector<std::uint32_t> vertex_of_partner_;
  /// for each polygon of the first side: whether the walk has visited the polygon
  std::vector<bool> is_visited_;
  std::vector<FaceEdgePair> faces_;  ///< visited pairs of polygons, in the order of visits
  std::vector<MirroredPair> pairs_;  ///< the vertex pairs found so far
};

}  // namespace crowdface
