// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/cast_crowd.h"

namespace crowdface {

/// What would have made a crowd possible that fell short.
struct Remedy {
  Reason binding = Reason::kMinDistance;  ///< what threw most candidates away
  /// The largest value of the binding distance, in whole hundredths of a millimetre, with which a
  /// cast was tried and done. None if another constraint binds or none was found.
  std::optional<double> largest_mm;
  std::uint64_t tried = 0;  ///< faces of these trials: the whole count, or its first 400
};

/// Looks for it by casting again with smaller distances, closing in from both sides until what works
/// and what fails are an eighth apart or twenty thousand candidates were drawn. A trial takes a
/// time that grows with the square of its faces, so that large crowds are tried by their beginning.
/// \param tried  called after each trial.
Remedy find_remedy(const Casting& casting, const FaceSpace& space,
                   const BelievabilityOptions& believability, const ProxySkin* skin,
                   const Shortfall& shortfall, const std::function<void()>& tried = {});

/// Whether a spread crowd is far out of reach: then not even an eighth as many faces are found one
/// after the other. Told in seconds, where a pool for all of them would take hours.
/// \return nothing if it may be reached.
std::optional<Shortfall> hopeless_spread(const Casting& casting, const FaceJudge& judge);

}  // namespace crowdface
