// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/cast_crowd.h"

namespace crowdface {

/// What would have made a crowd possible that fell short.
struct Remedy {
  Reason binding = Reason::kMinDistance;  ///< what threw most candidates away
  /// The largest value of the binding distance, in whole hundredths of a millimetre, with which a
  /// cast of the whole count was tried and done. None if another constraint binds or none was found.
  std::optional<double> largest_mm;
};

/// Looks for it by casting again with smaller distances, closing in from both sides until what works
/// and what fails are an eighth apart or a hundred thousand candidates were drawn.
Remedy find_remedy(const Casting& casting, const FaceSpace& space,
                   const BelievabilityOptions& believability, const ProxySkin* skin,
                   const Shortfall& shortfall);

}  // namespace crowdface
