// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/face_space.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// Who stands among the heads of a group for each head that is none of them: a father's sister for the
/// father, where daughters are made of women's heads alone. It is the one that has most tags in common with
/// him, of these rather one that is no parent's, and then the one most like him in shape, apart from what
/// sets the group's mean apart from the mean of all others.
class StandIns {
 public:
  /// Everyone stands for himself.
  StandIns() = default;
  /// \param group  ascending, not empty. \param tags  #heads, or none known. \param taken  heads of parents.
  StandIns(const std::vector<Index>& group, const HeadTags& tags, const std::vector<Index>& taken,
           const FaceSpace& space);

  /// \param shares  ascending heads. \return  the same of heads of the group.
  std::vector<SourceWeight> of(const std::vector<SourceWeight>& shares) const;
  /// Whether they are of the group themselves.
  bool has_all(const std::vector<SourceWeight>& shares) const;

 private:
  std::vector<Index> of_head_;  ///< #heads, or empty
};

/// How many of one's tags another has, too.
std::size_t common_tags(const std::vector<std::string>& one, const std::vector<std::string>& other);

}  // namespace crowdface
