// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A directed edge, in the winding order of a face.
struct DirectedEdge {
  std::uint32_t from, to;
};

/// A vertex and its mirror partner.
struct MirroredPair {
  std::uint32_t vertex, partner;
};

/// Walks over two sides of a mesh simultaneously to find mirror partners. The constructor allocates
/// the work arrays. One object must not be used by several threads at once.
class MirroredWalk {
 public:
  /// \param topology  Must outlive this object.
  /// \param around    Must outlive this object.
  MirroredWalk(const Topology& topology, const VertexFaces& around);

  /// Walks from face to face on both sides simultaneously, with opposite winding on the second
  /// side, as long as corresponding faces have equally many corners and each vertex always gets the
  /// same partner.
  ///
  /// \param edge     An edge of a face on the first side.
  /// \param other    Its mirror image on the second side: from the partner of edge.to to the
  ///                 partner of edge.from.
  /// \param goes_on  Called once for each new pair. If it returns false, the walk ends without
  ///                 result.
  /// \return         All pairs found, or nothing if the two sides do not match.
  std::optional<std::vector<MirroredPair>> from(
      DirectedEdge edge, DirectedEdge other,
      const std::function<bool(const MirroredPair&)>& goes_on);

 private:
  /// An edge of a face: the face, and the corner where the edge begins.
  struct FaceEdge {
    std::uint32_t face;
    std::size_t corner;
  };
  struct FacePair {
    FaceEdge here, there;
  };

  std::optional<FaceEdge> face_along(DirectedEdge edge) const;
  bool reach(DirectedEdge here, DirectedEdge there);
  bool pair(MirroredPair pair);
  bool pair_corners(const FacePair& faces, const std::function<bool(const MirroredPair&)>& goes_on);
  bool go(DirectedEdge edge, DirectedEdge other,
          const std::function<bool(const MirroredPair&)>& goes_on);
  void forget();

  const Topology& topology_;
  const VertexFaces& around_;
  // State of the current walk:
  /// #V; kNoIndex for vertices without partner
  std::vector<std::uint32_t> partner_of_, vertex_of_;
  std::vector<bool> met_;        ///< #F of the first side
  std::vector<FacePair> faces_;  ///< in the order they are found
  std::vector<MirroredPair> pairs_;
};

}  // namespace crowdface
