// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/cast_crowd.h"

namespace crowdface {

/// A smaller distance limit that lets casting complete a crowd.
struct Remedy {
  /// the constraint that rejected most candidates
  RejectionReason binding_constraint = RejectionReason::kMinDistance;
  /// Largest value of the constraint's distance, in whole hundredths of a millimetre, with which
  /// casting succeeded. Empty if the constraint has no distance, or if no value succeeded.
  std::optional<double> largest_distance_mm;
  /// Number of faces in each trial: the count of the crowd or a limit, whichever is smaller. The
  /// limit is 400 if the mode is spread mode or if casting judges whole meshes; otherwise it is
  /// 4000.
  std::uint64_t trial_face_count = 0;
};

/// Searches for a remedy. Casts again with smaller distances, and bisects until the smallest
/// distance that fails is at most 8 % above the largest distance that works. Also stops when all
/// trials together have used 200,000 candidates and a trial has succeeded.
///
/// The trials of the bisection check coarse meshes only. If the judge checks whole meshes, up to
/// four further trials check whole meshes: the first with the distance that the bisection found,
/// each further trial with a distance 7 % smaller. If all four trials fail,
/// Remedy::largest_distance_mm is empty.
///
/// \param trial_done  Called after each trial.
Remedy find_remedy(const CastingOptions& casting, const FaceJudge& judge,
                   const Shortfall& shortfall, const std::function<void()>& trial_done = {});

/// Checks in seconds whether a crowd of more than 3200 faces is impossible in spread mode: tries to
/// place 400 faces by first fit. Spread mode finds at most twice as many faces as first fit. So if
/// first fit cannot place 400 faces, spread mode finds at most 800 faces, and more than 3200 faces
/// are impossible. (Sampling the pool of candidates for the whole crowd would take hours.)
///
/// \return  The shortfall of the 400 faces; nothing if the crowd may be possible.
std::optional<Shortfall> shortfall_if_spread_impossible(const CastingOptions& casting,
                                                        const FaceJudge& judge);

}  // namespace crowdface
