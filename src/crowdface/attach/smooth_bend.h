// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/attach/bend_places.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Moves points beside a skin smoothly with it: at places among the points the best turn, shift and
/// scale of the skin around, and between them a mean of what these do (moving least squares, Schaefer
/// et al. 2006, with similarities). Places are the denser the nearer the skin is. A face that is the
/// fitted mesh, turned, moved and scaled, has them turned, moved and scaled, up to rounding.
class SmoothBend {
 public:
  /// \param skin    must outlive this object.
  /// \param points  #P by 3, beside the fitted mesh; likewise.
  SmoothBend(const FittedSkin& skin, const Positions& points);

  /// \param face  #V by 3. \return #P by 3.
  Positions bend(const Positions& face) const;

  std::size_t memory_bytes() const { return places_.memory_bytes(); }

 private:
  const FittedSkin& skin_;
  const Positions& points_;
  BendPlaces places_;
};

}  // namespace crowdface
