// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// An edge from `from` to `to`, as a face runs through it.
struct DirectedEdge {
  std::uint32_t from, to;
};

/// Vertices that answer each other if faces are mirrored.
struct MirroredPair {
  std::uint32_t vertex, partner;
};

/// Walks over the faces of two sides of a mesh; what it needs for that is made once.
class MirroredWalk {
 public:
  /// Both must outlive this object.
  MirroredWalk(const Topology& topology, const FacesAround& around);

  /// Goes from face to face on two sides of a mesh at once, the other way round on the second, for as long
  /// as faces there have as many corners and vertices meet the same partners as before.
  /// \param edge   of a face on the first side
  /// \param other  its image, of a face on the second: runs from the partner of edge.to to that of edge.from
  /// \param goes_on  asked of each pair when it is met; where it says no, the walk is given up
  /// \return  all vertices that were met; nothing if the sides are not alike
  std::optional<std::vector<MirroredPair>> from(
      DirectedEdge edge, DirectedEdge other,
      const std::function<bool(const MirroredPair&)>& goes_on);

 private:
  /// Where a face runs through an edge: its corner at the edge's beginning.
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
  const FacesAround& around_;
  // Of the walk that is under way:
  std::vector<std::uint32_t> partner_of_, vertex_of_;  ///< #V, kNoIndex where none is met
  std::vector<bool> met_;                              ///< #F, of the first side
  std::vector<FacePair> faces_;                        ///< met, in this order
  std::vector<MirroredPair> pairs_;
};

}  // namespace crowdface
