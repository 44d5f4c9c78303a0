// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/estimate.h"

#include <algorithm>
#include <cmath>

#include "crowdface/cast/shares.h"
#include "crowdface/cast/spread.h"
#include "crowdface/core/interrupt.h"

namespace crowdface {
namespace {

constexpr int kCountHalvings = 7;
/// The pool must contain at least this many candidates for each face of a crowd.
constexpr std::uint64_t kMinCandidatesPerFace = 5;

/// Returns how many candidates of the pool, taken in order, first-fit casting keeps at this minimum
/// distance. Stops counting at `enough`.
std::uint64_t first_fit_count(const CandidatePool& pool, double mm, std::uint64_t enough) {
  NearestFaceSearch kept(pool.points[0].coordinates_with_extrapolation.size());
  for (const FaceSpace::Point& point : pool.points) {
    if (static_cast<std::uint64_t>(kept.size()) >= enough) break;
    if (kept.nearest(point, mm).face < 0) kept.add(point);
  }
  return static_cast<std::uint64_t>(kept.size());
}

}  // namespace

std::vector<EstimateRow> estimate_capacity(const CastingOptions& casting, const FaceJudge& judge,
                                           const std::vector<std::uint64_t>& counts,
                                           std::uint64_t pool_size) {
  // The estimate ignores the crowd's groups, because each group would need a separate pass.
  CastingOptions ungrouped = casting;
  ungrouped.groups.clear();
  const CandidatePool pool =
      sample_pool(ungrouped, judge, face_distributions(ungrouped), pool_size);
  const CrowdSoFar nobody(judge.space().dimensions());
  FarthestPoints points(pool, nobody);
  // for each n: the distance of the closest pair among the first n picks
  std::vector<double> closest;
  std::uint64_t most = 0;
  for (const std::uint64_t count : counts) {
    if (count * kMinCandidatesPerFace <= pool.faces.size()) most = std::max(most, count);
  }
  while (closest.size() < most) {
    throw_if_interrupted();
    const FarthestPoints::Pick pick = points.farthest(-1);
    if (pick.candidate < 0) break;
    if (judge.check_skin(pool.faces[static_cast<std::size_t>(pick.candidate)].recipe)) {
      points.remove(pick.candidate);
      continue;
    }
    points.pick(pick.candidate);
    closest.push_back(closest.empty() ? pick.distance_mm
                                      : std::min(closest.back(), pick.distance_mm));
  }
  // For each crowd size, find by bisection the largest distance at which first-fit casting
  // succeeds.
  std::vector<EstimateRow> rows;
  for (const std::uint64_t count : counts) {
    if (count < 2 || count > closest.size()) continue;
    EstimateRow row{count, closest[count - 1], 0};
    double works = 0, fails = 1.2 * row.distance_in_spread_mode_mm;
    for (int i = 0; i < kCountHalvings; ++i) {
      throw_if_interrupted();
      const double mm = 0.5 * (works + fails);
      (first_fit_count(pool, mm, count) >= count ? works : fails) = mm;
    }
    row.distance_in_first_fit_casting_mm = works;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace crowdface
