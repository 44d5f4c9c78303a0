// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace crowdface {

/// What may sit on a face.
struct AttachmentItem {
  std::string name, kind;
  std::vector<std::string> tags;      ///< only for faces whose typical_head has all of these
  double share = 1;                   ///< against the others of its kind
  std::vector<std::string> excludes;  ///< names and kinds of what it does not go with
  std::string colour = {};            ///< what goes together in one face and runs in families
};

/// What an attachment counts for: its kind, name and colour.
inline bool is_called(const AttachmentItem& item, const std::string& word) {
  return item.kind == word || item.name == word || item.colour == word;
}

}  // namespace crowdface
