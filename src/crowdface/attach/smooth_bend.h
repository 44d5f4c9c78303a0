// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/core/grouped.h"
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

  std::size_t places() const { return places_.size(); }
  std::size_t memory_bytes() const;

 private:
  struct Share {
    std::uint32_t place;
    float weight;  ///< those of a point add up to about one
  };

  const FittedSkin& skin_;
  const Positions& points_;
  std::vector<FittedSkin::Patch> places_;
  Grouped<Share> shares_;  ///< #P
};

}  // namespace crowdface
