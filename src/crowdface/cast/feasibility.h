// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/cast_crowd.h"

namespace crowdface {

/// A change of the limits that would make a crowd with a shortfall possible.
struct Remedy {
  Reason binding_constraint = Reason::kMinDistance;  ///< constraint that rejected most candidates
  /// Largest value of the binding distance, in whole hundredths of a millimetre, with which casting
  /// succeeded. Empty if the binding constraint is not a distance, or if no value succeeded.
  std::optional<double> largest_distance_mm;
  /// number of faces in the trials: the whole count, or its first 400
  std::uint64_t trial_faces = 0;
};

/// Searches for a remedy: casts again with smaller distances, and bisects until the smallest
/// distance that fails is at most 8 % above the largest distance that works, or until the trials
/// have used 200,000 candidates. The time of a trial grows with the square of its faces, so the
/// trials of a large crowd cast only the first faces.
///
/// \param trial_done  Called after each trial.
/// \param meshes      If given, trials also judge the candidates' meshes. After four failed trials,
///                    the remedy has no distance.
Remedy find_remedy(const CastingOptions& casting, const FaceSpace& space,
                   const BelievabilityOptions& believability, const ProxySkin* skin,
                   const Shortfall& shortfall, const std::function<void()>& trial_done = {},
                   const TraitRules* traits = nullptr, const FindMeshDefects& meshes = {});

/// Checks in seconds whether a crowd of more than 3200 faces in spread mode is impossible: places
/// up to 400 faces by first fit. Spread mode finds at most twice as many faces as first fit, so if
/// first fit cannot place 400 faces, the crowd is impossible. A pool of candidates for the whole
/// crowd would take hours.
///
/// \return  The shortfall of the 400 faces; nothing if the crowd may be possible.
std::optional<Shortfall> impossible_spread(const CastingOptions& casting, const FaceJudge& judge);

}  // namespace crowdface
