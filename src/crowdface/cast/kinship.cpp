// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/kinship.h"

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

bool Kinship::intrudes(const FaceSpace::Point& point,
                       const std::vector<std::string>& relatives) const {
  return std::any_of(members_.begin(), members_.end(), [&](const Member& member) {
    return std::find(relatives.begin(), relatives.end(), member.family) == relatives.end() &&
           FaceSpace::distance(point, member.point) <= member.radius_mm;
  });
}

void Kinship::add(const std::string& family, const std::vector<FaceSpace::Point>& members) {
  for (const FaceSpace::Point& point : members) {
    members_.push_back({family, point, largest(point, members)});
  }
}

Strangers::Strangers(const Casting& casting, const FaceSpace& space) {
  const bool needed = std::any_of(casting.families.begin(), casting.families.end(),
                                  [](const auto& family) { return !family.parents.empty(); });
  if (!needed) return;
  points_.resize(kStrangers);
  parallel_for_each(static_cast<Index>(kStrangers), [&](Index i) {
    const DrawKey key = {static_cast<std::uint64_t>(i), 0, "stranger"};
    points_[static_cast<std::size_t>(i)] =
        space.point(draw_recipe(casting, {}, key, kind_of_group(casting)).recipe);
  });
}

double Strangers::share_nearer(const FaceSpace::Point& point, double mm) const {
  const auto nearer = std::count_if(points_.begin(), points_.end(), [&](const auto& stranger) {
    return FaceSpace::distance(point, stranger) < mm;
  });
  return points_.empty() ? 0 : static_cast<double>(nearer) / static_cast<double>(points_.size());
}

}  // namespace crowdface
