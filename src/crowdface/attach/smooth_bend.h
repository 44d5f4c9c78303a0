// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/attach/bend_nodes.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Moves points smoothly with the nearby skin (moving least squares, Schaefer et al. 2006, with
/// similarities). Some points are nodes. The surrounding skin determines the rotation, translation
/// and scale of each node. Each point moves by a weighted mean of the motions of nearby nodes.
/// Nodes are denser near the skin. If the face is a rotated, translated and scaled copy of the
/// fitted mesh, the points are rotated, translated and scaled like the face, except for rounding
/// errors.
class SmoothBend {
 public:
  /// \param skin    Must outlive this object.
  /// \param points  #P by 3, on the fitted mesh; must outlive this object.
  SmoothBend(const FittedSkin& skin, const Positions& points);

  /// Moves the points with the skin of a face.
  /// \param face  #V by 3.
  /// \return      Points on the face, #P by 3.
  Positions bend(const Positions& face) const;

  std::size_t memory_bytes() const { return nodes_.memory_bytes(); }

 private:
  const FittedSkin& skin_;
  /// #P by 3: positions of the attachment's vertices on the head to which the attachment was fitted
  const Positions& points_;
  BendNodes nodes_;  ///< the nodes, and their weights in the motion of each point
};

}  // namespace crowdface
