// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace crowdface {

/// An attachment that a face may wear.
struct AttachmentItem {
  std::string name, kind;
  std::vector<std::string> tags;      ///< only for faces whose typical_head has all of these
  double share = 1;                   ///< relative frequency within its kind
  std::vector<std::string> excludes;  ///< names and kinds that cannot be worn with this item
  /// colour shared by the items of a face, and inherited in families
  std::string colour = {};
};

/// Returns whether a word is the item's kind, name or colour.
inline bool is_called(const AttachmentItem& item, const std::string& word) {
  return item.kind == word || item.name == word || item.colour == word;
}

}  // namespace crowdface
