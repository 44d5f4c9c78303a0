// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/cast_crowd.h"

namespace crowdface {

/// What would make a crowd with a shortfall possible.
struct Remedy {
  Reason binding = Reason::kMinDistance;  ///< constraint that rejected most candidates
  /// Largest value of the binding distance, in whole hundredths of a millimetre, with which casting
  /// succeeded. Empty if the binding constraint is no distance, or if no value was found.
  std::optional<double> largest_mm;
  std::uint64_t tried = 0;  ///< number of faces in the trials: the whole count, or its first 400
};

/// Searches for a remedy by casting again with smaller distances, closing in from both sides until
/// the smallest value that fails is at most an eighth above the largest that works, or until 20,000
/// candidates were drawn. The time of a trial grows with the square of its faces, so only the
/// beginning of a large crowd is tried.
///
/// \param tried  Called after each trial.
Remedy find_remedy(const CastingOptions& casting, const FaceSpace& space,
                   const BelievabilityOptions& believability, const ProxySkin* skin,
                   const Shortfall& shortfall, const std::function<void()>& tried = {});

/// Checks quickly whether a large spread crowd is hopeless: whether first fit cannot place even 400
/// faces, less than an eighth of the crowd. Takes seconds, whereas drawing the pool would take
/// hours.
///
/// \return  Nothing if the crowd may be possible.
std::optional<Shortfall> hopeless_spread(const CastingOptions& casting, const FaceJudge& judge);

}  // namespace crowdface
