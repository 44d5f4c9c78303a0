// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/spread.h"

#include <algorithm>
#include <cmath>

#include "crowdface/cast/face_ids.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::size_t kCandidatesAtATime = 256;

/// Returns the squared distance between two points, or an arbitrary value above `limit` if the
/// squared distance exceeds `limit`.
double bounded_squared_distance(const Eigen::VectorXf& a, const Eigen::VectorXf& b, double limit) {
  constexpr Index kLanes = 8, kChunk = 32;
  double sum = 0;
  for (Index begin = 0; begin < a.size() && sum <= limit; begin += kChunk) {
    const Index end = std::min(a.size(), begin + kChunk);
    float lanes[kLanes] = {};
    Index i = begin;
    for (; i + kLanes <= end; i += kLanes) {
      for (Index l = 0; l < kLanes; ++l) {
        const float d = a[i + l] - b[i + l];
        lanes[l] += d * d;
      }
    }
    for (Index l = 0; i < end; ++i, ++l) {
      const float d = a[i] - b[i];
      lanes[l] += d * d;
    }
    for (const float lane : lanes) sum += static_cast<double>(lane);
  }
  return sum;
}

double bounded_squared_distance(const FaceSpace::Point& a, const FaceSpace::Point& b,
                                double limit) {
  const double squared_distance_with_extrapolation = bounded_squared_distance(
      a.coordinates_with_extrapolation, b.coordinates_with_extrapolation, limit);
  return std::min(squared_distance_with_extrapolation,
                  bounded_squared_distance(a.coordinates_without_extrapolation,
                                           b.coordinates_without_extrapolation,
                                           std::min(limit, squared_distance_with_extrapolation)));
}

}  // namespace

CandidatePool sample_pool(const CastingOptions& casting, const FaceJudge& judge,
                          const std::vector<FaceDistribution>& distributions, std::uint64_t count,
                          std::uint64_t pool_size_factor) {
  const std::uint64_t size = count * pool_size_factor;
  const std::vector<int> schedule = schedule_groups(casting.groups, size, pool_size_factor);
  std::vector<std::optional<std::pair<FacePlan, FaceSpace::Point>>> drawn(size);
  std::vector<RejectionCounts> rejections(size);
  parallel_for_each(size, [&](std::size_t at) {
    if (at % 1024 == 0) throw_if_interrupted();
    const FaceDistribution& kind = distributions[static_cast<std::size_t>(schedule[at] + 1)];
    const bool limited = judge.trait_rules() != nullptr && !kind.sampling->traits.empty();
    const int attempts =
        casting.diversity.max_attempts * (limited ? static_cast<int>(kAttemptFactorWithTraits) : 1);
    for (int attempt = 0; attempt < attempts; ++attempt) {
      const FaceRandomKey key = {at + 1, static_cast<std::uint32_t>(attempt), "pool"};
      FacePlan face = random_face_plan(casting, {}, key, kind);
      face.index = key.index;  // a sampled face, see TraitRules::limits_of
      auto reason = judge.check_traits(face, judge.landmarks(face.recipe));
      FaceSpace::Point point;
      if (!reason) {
        point = judge.space().point(face.recipe);
        reason = judge.check_candidate(face.recipe, point, key.attempt);
      }
      if (reason) {
        rejections[at].add(*reason);
        continue;
      }
      drawn[at].emplace(std::move(face), std::move(point));
      return;
    }
  });
  CandidatePool pool;
  for (std::size_t p = 0; p < size; ++p) {
    pool.rejections.add(rejections[p]);
    if (!drawn[p]) continue;
    pool.faces.push_back(std::move(drawn[p]->first));
    pool.points.push_back(std::move(drawn[p]->second));
    pool.group_indices.push_back(schedule[p]);
  }
  return pool;
}

FarthestPoints::FarthestPoints(const CandidatePool& pool, const CrowdSoFar& crowd)
    : pool_(pool),
      squared_distances_(pool.points.size(), HUGE_VAL),
      removed_(pool.points.size(), false) {
  parallel_for_each(squared_distances_.size(), [&](std::size_t at) {
    const double mm = crowd.nearest_search().nearest(pool_.points[at]).distance_mm;
    squared_distances_[at] = mm * mm;
  });
}

FarthestPoints::Pick FarthestPoints::farthest(int group_index) const {
  Pick best;
  double most = -1;
  for (std::size_t p = 0; p < squared_distances_.size(); ++p) {
    if (removed_[p] || pool_.group_indices[p] != group_index || squared_distances_[p] <= most)
      continue;
    most = squared_distances_[p];
    best.candidate = static_cast<Index>(p);
  }
  best.distance_mm = std::sqrt(std::max(most, 0.0));
  return best;
}

void FarthestPoints::pick(Index candidate) {
  remove(candidate);
  const FaceSpace::Point& picked = pool_.points[static_cast<std::size_t>(candidate)];
  parallel_for_each(squared_distances_.size(), kCandidatesAtATime, [&](std::size_t at) {
    if (removed_[at]) return;
    squared_distances_[at] =
        std::min(squared_distances_[at],
                 bounded_squared_distance(picked, pool_.points[at], squared_distances_[at]));
  });
}

void cast_spread(const CastingOptions& casting, const FaceJudge& judge,
                 const std::vector<FaceDistribution>& distributions,
                 const FamilySeparation& family_separation, CrowdSoFar& crowd,
                 const FaceJoinedCallback& on_face_joined, CastingResult& result) {
  CandidatePool pool =
      sample_pool(casting, judge, distributions, casting.count, DiversityOptions::kPoolSizeFactor);
  result.rejections.add(pool.rejections);
  FarthestPoints points(pool, crowd);
  for (std::uint64_t index = 1; index <= casting.count; ++index) {
    throw_if_interrupted();
    const int group_index = result.group_indices[index - 1];
    FarthestPoints::Pick pick = points.farthest(group_index);
    while (pick.candidate >= 0) {
      const auto at = static_cast<std::size_t>(pick.candidate);
      std::optional<RejectionReason> why = judge.check_traits(pool.faces[at]);
      if (!why) why = judge.check_skin(pool.faces[at].recipe);
      if (!why && family_separation.is_too_near_to_family(pool.points[at]))
        why = RejectionReason::kFamily;
      if (!why) break;
      result.rejections.add(*why);
      points.remove(pick.candidate);
      pick = points.farthest(group_index);
    }
    if (pick.candidate < 0 || pick.distance_mm < casting.diversity.min_distance_mm) {
      RejectionCounts why = pool.rejections;
      if (pick.candidate >= 0) why.add(RejectionReason::kMinDistance, why.total() + 1);
      result.shortfall = Shortfall{index - 1, why, group_index};
      return;
    }
    points.pick(pick.candidate);
    const auto at = static_cast<std::size_t>(pick.candidate);
    FacePlan face = pool.faces[at];
    face.id = face_id(casting.name, index);
    face.index = index;
    crowd.add(std::move(face), pool.points[at]);
    if (on_face_joined) on_face_joined({});
  }
}

}  // namespace crowdface
