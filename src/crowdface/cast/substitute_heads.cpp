// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/substitute_heads.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "crowdface/core/contains.h"

namespace crowdface {
namespace {

/// Returns the mean point of several heads in face space.
///
/// \param inside  true: the heads of the group; false: all other heads.
Eigen::VectorXf mean_point(const FaceSpace& space, const std::vector<Index>& group, bool inside) {
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(space.dimensions());
  float count = 0;
  for (Index head = 0; head < space.head_count(); ++head) {
    if (contains(group, head) != inside) continue;
    sum += space.head_point(head).coordinates_with_extrapolation;
    count += 1;
  }
  return count > 0 ? Eigen::VectorXf(sum / count) : sum;
}

}  // namespace

std::size_t common_tag_count(const std::vector<std::string>& one,
                             const std::vector<std::string>& other) {
  return static_cast<std::size_t>(
      std::count_if(one.begin(), one.end(), [&](const auto& tag) { return contains(other, tag); }));
}

SubstituteHeads::SubstituteHeads(const std::vector<Index>& group, const HeadTags& tags,
                                 const std::vector<Index>& parents_heads, const FaceSpace& space) {
  const Eigen::VectorXf apart = mean_point(space, group, true) - mean_point(space, group, false);
  for (Index head = 0; head < space.head_count(); ++head) {
    if (contains(group, head)) {
      substitutes_.push_back(head);
      continue;
    }
    const Eigen::VectorXf place = space.head_point(head).coordinates_with_extrapolation + apart;
    const auto rank = [&](Index other) {
      const std::size_t common = tags.empty()
                                     ? 0
                                     : common_tag_count(tags[static_cast<std::size_t>(head)],
                                                        tags[static_cast<std::size_t>(other)]);
      return std::tuple(-static_cast<std::ptrdiff_t>(common), contains(parents_heads, other),
                        (space.head_point(other).coordinates_with_extrapolation - place).norm());
    };
    substitutes_.push_back(*std::min_element(group.begin(), group.end(),
                                             [&](Index a, Index b) { return rank(a) < rank(b); }));
  }
}

std::vector<SourceWeight> SubstituteHeads::substituted(
    const std::vector<SourceWeight>& weights) const {
  if (contains_all(weights)) return weights;
  std::map<Index, double> sums;
  for (const SourceWeight& share : weights) {
    sums[substitutes_[static_cast<std::size_t>(share.head)]] += share.weight;
  }
  std::vector<SourceWeight> result;
  for (const auto& [head, weight] : sums) result.push_back({head, weight});
  return result;
}

bool SubstituteHeads::contains_all(const std::vector<SourceWeight>& weights) const {
  return substitutes_.empty() ||
         std::all_of(weights.begin(), weights.end(), [&](const auto& share) {
           return substitutes_[static_cast<std::size_t>(share.head)] == share.head;
         });
}

}  // namespace crowdface
