// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/face_space.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// Substitutes heads outside a group by similar heads of the group. Example: if daughters may only
/// be made of women's heads, a woman's head replaces each head of the father. The substitute has
/// the most tags in common with the original. Ties are decided first in favour of heads that no
/// parent uses, then in favour of the nearest shape, after subtraction of the difference between
/// the mean of the group and the mean of all other heads.
class SubstituteHeads {
 public:
  /// No head is substituted.
  SubstituteHeads() = default;
  /// \param group  Heads of the group; ascending, not empty.
  /// \param tags   #heads, or empty if unknown.
  /// \param taken  Heads of the parents.
  SubstituteHeads(const std::vector<Index>& group, const HeadTags& tags,
                  const std::vector<Index>& taken, const FaceSpace& space);

  /// Returns weights with each head replaced by its substitute.
  ///
  /// \param shares  Weights, by ascending head.
  std::vector<SourceWeight> substituted(const std::vector<SourceWeight>& shares) const;
  /// Returns whether the group contains every head in `shares`.
  bool contains_all(const std::vector<SourceWeight>& shares) const;

 private:
  std::vector<Index> substitutes_;  ///< #heads: substitute of each head; or empty
};

/// Returns how many tags two heads have in common.
std::size_t common_tag_count(const std::vector<std::string>& one,
                             const std::vector<std::string>& other);

}  // namespace crowdface
