// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/feasibility.h"

#include <algorithm>
#include <cmath>

namespace crowdface {
namespace {

/// No further trial begins once all trials together have used this number of candidates, provided
/// that a trial has succeeded.
constexpr std::uint64_t kMaxTrialCandidates = 200'000;
/// Largest number of faces in a trial. Casting takes about a millisecond for each face.
constexpr std::uint64_t kMaxTrialFaces = 4000;
/// Largest number of faces in a slow trial: a trial in spread mode, which takes a time proportional
/// to the square of the number of faces, or a trial that judges whole meshes.
constexpr std::uint64_t kMaxSlowTrialFaces = 400;
/// Bisection stops when the smallest distance that fails is at most this factor times the largest
/// distance that works.
constexpr double kBisectionRatio = 1.08;

double whole_hundredths(double mm) {
  return std::floor(mm * 100) / 100;
}

/// Largest number of trials that judge whole meshes. A trial with whole meshes takes a hundred
/// times as long as a trial without.
constexpr int kMaxMeshTrials = 4;

/// Returns a smaller distance to try. At the distance `fails`, only `reached` of `count` faces fit.
/// The number of faces that fit is proportional to a power of the distance, with an exponent
/// between −2.5 and −5.
double smaller_distance(double fails, std::uint64_t reached, std::uint64_t count) {
  const double share = (static_cast<double>(reached) + 0.5) / (static_cast<double>(count) + 1);
  return fails * std::clamp(std::pow(share, 0.4), 0.6, 0.93);
}

}  // namespace

Remedy find_remedy(const CastingOptions& casting, const FaceJudge& judge,
                   const Shortfall& shortfall, const std::function<void()>& trial_done) {
  Remedy remedy;
  remedy.binding_constraint = shortfall.rejections.most_frequent();
  CastingOptions easier = casting;
  if (shortfall.what != Shortfall::What::kSampledFace) return remedy;
  easier.reviews.clear();
  easier.changes.clear();
  const bool is_slow =
      casting.diversity.mode == DiversityOptions::Mode::kSpread || judge.checks_meshes();
  easier.count = std::min(casting.count, is_slow ? kMaxSlowTrialFaces : kMaxTrialFaces);
  remedy.trial_face_count = easier.count;
  const Constraint& constraint = constraint_of(remedy.binding_constraint);
  if (!constraint.is_distance()) return remedy;
  double& distance = easier.diversity.*constraint.diversity_limit;
  std::uint64_t draws = 0;
  FaceJudge coarse = judge;
  coarse.stop_mesh_checks();
  const auto shortfall_at = [&](double mm, FaceJudge of_trial) {
    distance = mm;
    of_trial.set_diversity(easier.diversity);
    const CastingResult cast = cast_crowd(easier, of_trial);
    draws += cast.rejections.total() +
             cast.crowd.size() * static_cast<std::uint64_t>(easier.diversity.candidate_count(1));
    if (trial_done) trial_done();
    return cast.shortfall;
  };
  double works = 0, fails = distance;
  double next = smaller_distance(fails, std::min(shortfall.cast_count, easier.count), easier.count);
  while ((draws < kMaxTrialCandidates || works == 0) && fails >= kBisectionRatio * works) {
    const double mm = whole_hundredths(next);
    if (mm <= works) break;
    if (const auto missing = shortfall_at(mm, coarse)) {
      fails = mm;
      next = works > 0 ? std::sqrt(works * fails)
                       : smaller_distance(fails, missing->cast_count, easier.count);
    } else {
      works = mm;
      next = std::sqrt(works * fails);
    }
  }
  // The trials above check coarse meshes only. Repeat the check with whole meshes.
  for (int trial = 0; judge.checks_meshes() && works > 0 && shortfall_at(works, judge); ++trial) {
    works = trial + 1 < kMaxMeshTrials ? whole_hundredths(0.93 * works) : 0;
  }
  if (works > 0) remedy.largest_distance_mm = works;
  return remedy;
}

std::optional<Shortfall> shortfall_if_spread_impossible(const CastingOptions& casting,
                                                        const FaceJudge& judge) {
  // spread mode finds at most twice as many faces as first fit; a factor of 8 leaves a margin
  constexpr std::uint64_t kMaxSpreadToFirstFitRatio = 8;
  const bool is_large = casting.count > kMaxSpreadToFirstFitRatio * kMaxSlowTrialFaces;
  if (casting.diversity.mode != DiversityOptions::Mode::kSpread || !is_large ||
      !(casting.diversity.min_distance_mm > 0)) {
    return std::nullopt;
  }
  CastingOptions first_fit = casting;
  first_fit.diversity.mode = DiversityOptions::Mode::kFirstFit;
  first_fit.reviews.clear();
  first_fit.changes.clear();
  first_fit.count = kMaxSlowTrialFaces;
  return cast_crowd(first_fit, judge).shortfall;
}

}  // namespace crowdface
