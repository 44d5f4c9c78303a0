// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/hair_colour.h"

namespace crowdface {

/// An attachment that a face may wear.
struct AttachmentItem {
  std::string name, kind;  ///< name of the item, and its kind, such as "hair"
  /// the typical head of the face (see typical_head) must have all of these tags
  std::vector<std::string> tags;
  /// frequency relative to the other items of the same kind (key `share`)
  double relative_frequency = 1;
  /// names and kinds of items that cannot be worn together with this item
  std::vector<std::string> excludes;
  /// Colour of the item. Other items of the same face get this colour if possible, and families
  /// inherit this colour.
  std::string colour = {};
  std::vector<std::string> excluded_tags = {};  ///< the typical head must have none of these tags
  /// kind of hair that the item represents. On each face, the item gets the colour of the face's
  /// hair of this kind; see Tint.
  Tint tint = Tint::kNone;
};

/// Returns whether `word` is the item's kind, name or colour.
inline bool matches_kind_name_or_colour(const AttachmentItem& item, const std::string& word) {
  return item.kind == word || item.name == word || item.colour == word;
}

}  // namespace crowdface
