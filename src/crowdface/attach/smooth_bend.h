// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/attach/bend_places.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Moves points smoothly with the skin beside them (moving least squares, Schaefer et al. 2006,
/// with similarities). At nodes among the points, the best rotation, translation and scale of the
/// surrounding skin is fitted; each point gets a weighted mean of these motions. Nodes are denser
/// near the skin. If the face is the fitted mesh, rotated, translated and scaled, the points
/// undergo the same motion up to rounding.
class SmoothBend {
 public:
  /// \param skin    Must outlive this object.
  /// \param points  #P by 3, on the fitted mesh; must outlive this object.
  SmoothBend(const FittedSkin& skin, const Positions& points);

  /// \param face  #V by 3.
  /// \return      Points on the face, #P by 3.
  Positions bend(const Positions& face) const;

  std::size_t memory_bytes() const { return places_.memory_bytes(); }

 private:
  const FittedSkin& skin_;
  const Positions& points_;
  BendPlaces places_;
};

}  // namespace crowdface
