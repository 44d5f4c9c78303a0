// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "crowdface/parts/part_list.h"
#include "crowdface/parts/socket.h"

namespace crowdface {

/// Named places beside a mesh that faces shall have too: joints, pivots of eyes, ear rings.
struct PointSet {
  std::vector<std::string> names;
  /// #names by 3 each, and the mesh beside which they stand, #V by 3: those of one template for all faces,
  /// or of each head for the faces built on it.
  std::vector<Positions> positions, meshes;

  bool empty() const { return names.empty(); }
};

/// Carries named points to faces, like parts: one that lies in an eyeball, or nearest to another rigid
/// part, goes with that as a whole; any other with the skin around it, by the best turn, shift and
/// scale of the skin nearest to it. A face that is the points' own mesh, turned, moved and scaled, has
/// them turned, moved and scaled, up to rounding.
class PointCarrier {
 public:
  /// \param skin  its vertices, at least three that are not on a line.
  PointCarrier(const PointSet& points, const PartList& parts, std::span<const std::uint32_t> skin);

  /// \param target  the head the face was built on: its own points are carried, if there are any.
  /// \param face    #V by 3.
  /// \return        #names by 3.
  Positions carry(Index target, const Positions& face) const;

 private:
  static Socket anchor_of(const Eigen::Vector3d& point, const Positions& mesh,
                          const PartList& parts, std::span<const std::uint32_t> skin);

  const PointSet& points_;
  std::vector<std::vector<Socket>> anchors_;  ///< #meshes by #names: what carries a point
};

}  // namespace crowdface
