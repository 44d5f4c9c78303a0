// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/hair_colour.h"

namespace crowdface {

/// An attachment that a face may wear.
struct AttachmentItem {
  std::string name, kind;
  std::vector<std::string> tags;      ///< the face's typical_head must have all of these tags
  double share = 1;                   ///< relative frequency within its kind
  std::vector<std::string> excludes;  ///< names and kinds that cannot be worn with this item
  /// colour that the face's other items share and that families inherit
  std::string colour = {};
  std::vector<std::string> excluded_tags = {};  ///< the typical head must have none of these tags
  Tint tint = Tint::kNone;
};

/// Returns whether `word` is the item's kind, name or colour.
inline bool matches_word(const AttachmentItem& item, const std::string& word) {
  return item.kind == word || item.name == word || item.colour == word;
}

}  // namespace crowdface
