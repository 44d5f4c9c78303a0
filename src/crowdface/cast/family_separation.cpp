// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/family_separation.h"

#include <algorithm>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::size_t kStrangers = 200;

double largest(const FaceSpace::Point& point, const std::vector<FaceSpace::Point>& others) {
  double mm = 0;
  for (const FaceSpace::Point& other : others) {
    mm = std::max(mm, FaceSpace::distance(point, other));
  }
  return mm;
}

}  // namespace

bool FamilySeparation::is_too_near_to_family(const FaceSpace::Point& point,
                                             const std::vector<std::string>& relatives) const {
  return std::any_of(members_.begin(), members_.end(), [&](const Member& member) {
    return std::find(relatives.begin(), relatives.end(), member.family) == relatives.end() &&
           FaceSpace::distance(point, member.point) <= member.distance_to_farthest_member_mm;
  });
}

void FamilySeparation::add(const std::string& family,
                           const std::vector<FaceSpace::Point>& members) {
  for (const FaceSpace::Point& point : members) {
    members_.push_back({family, point, largest(point, members)});
  }
}

UnrelatedFaces::UnrelatedFaces(const CastingOptions& casting, const FaceSpace& space) {
  for (const FamilyOptions& family : casting.families) {
    if (!family.parents.empty()) points_by_group_[family.group].resize(kStrangers);
  }
  for (auto& [group, points] : points_by_group_) {
    const FaceDistribution kind = distribution_of_group(casting, group);
    parallel_for_each(static_cast<Index>(kStrangers), [&, &points = points](Index i) {
      const FaceRandomKey key = {static_cast<std::uint64_t>(i), 0, "stranger"};
      points[static_cast<std::size_t>(i)] =
          space.point(random_face_plan(casting, {}, key, kind).recipe);
    });
  }
}

double UnrelatedFaces::fraction_nearer(const FaceSpace::Point& point, double distance_mm,
                                       std::optional<std::size_t> group) const {
  const auto found = points_by_group_.find(group);
  if (found == points_by_group_.end()) return 0;
  const auto& points = found->second;
  const auto nearer = std::count_if(points.begin(), points.end(), [&](const auto& stranger) {
    return FaceSpace::distance(point, stranger) < distance_mm;
  });
  return static_cast<double>(nearer) / static_cast<double>(points.size());
}

}  // namespace crowdface
