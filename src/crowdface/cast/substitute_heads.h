// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/face_space.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// Replaces heads outside a group by similar heads of the group. Example: if daughters may only be
/// made of women's heads, a woman's head replaces each head of the father. The substitute is the
/// head of the group that has the most tags in common with the replaced head. If several heads have
/// equally many tags in common, heads that no parent uses come first. Among these, the head with
/// the nearest point in face space is chosen. For this comparison, the replaced head's point is
/// moved by the mean of the group minus the mean of all other heads.
class SubstituteHeads {
 public:
  /// Makes an object that replaces no head.
  SubstituteHeads() = default;
  /// \param group  Heads of the group; ascending, not empty.
  /// \param tags   the tags of each head; empty if tags are unknown.
  /// \param parents_heads  Heads that the parents use.
  SubstituteHeads(const std::vector<Index>& group, const HeadTags& tags,
                  const std::vector<Index>& parents_heads, const FaceSpace& space);

  /// Returns weights in which each head outside the group is replaced by its substitute.
  ///
  /// \param weights  Weights, in ascending order of the heads' indices.
  std::vector<SourceWeight> substituted(const std::vector<SourceWeight>& weights) const;
  /// Returns whether the group contains every head in `weights`.
  bool contains_all(const std::vector<SourceWeight>& weights) const;

 private:
  /// the substitute of each head; empty if no head is replaced
  std::vector<Index> substitutes_;
};

/// Returns how many tags two heads have in common.
std::size_t common_tag_count(const std::vector<std::string>& one,
                             const std::vector<std::string>& other);

}  // namespace crowdface
