// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "crowdface/heads/face_attachments.h"
#include "crowdface/run/worn_level.h"

namespace crowdface {

/// Of each kind a face wears one attachment at most.
/// \param forms  by attachment. \return  the sum of the largest size of each kind.
template <class Form, class Size>
std::size_t worn_at_most(const std::map<const Attachment*, Form>& forms, const Size& size) {
  std::map<std::string, std::size_t> largest;
  for (const auto& [item, form] : forms) {
    std::size_t& most = largest[item->kind];
    most = std::max(most, static_cast<std::size_t>(size(*item, form)));
  }
  std::size_t sum = 0;
  for (const auto& [kind, most] : largest) sum += most;
  return sum;
}

/// Attachments in the form in which files of faces hold them beside the face's mesh.
/// \tparam Placed  one in the file of a face: a part, its positions and its moves.
template <class Part, class Placed>
class AttachmentParts {
 public:
  /// All whole, or those that somebody wears on a level of detail.
  /// \param level  null: whole. \param make  makes the part of an attachment on a level, or whole.
  template <class Make>
  AttachmentParts(const AttachmentSet& set, const WornLevel* level, const Make& make) {
    for (const Attachment& item : set.items) {
      const DetailLevel* here = level == nullptr ? nullptr : level->find(item);
      if (level == nullptr || here != nullptr) parts_.emplace(&item, make(item, here));
    }
  }
  /// Whole, and then on each of the levels.
  template <class Make>
  static std::vector<AttachmentParts> on_all(const AttachmentSet& set,
                                             std::span<const WornLevel> levels, const Make& make) {
    std::vector<AttachmentParts> all;
    all.emplace_back(set, nullptr, make);
    for (const WornLevel& level : levels) all.emplace_back(set, &level, make);
    return all;
  }

  /// What a face wears; refers to both.
  std::vector<Placed> parts(std::span<const WornAttachment> worn) const {
    std::vector<Placed> parts;
    for (const WornAttachment& one : worn) {
      parts.push_back({&parts_.at(one.item), &one.positions, one.moves});
    }
    return parts;
  }
  const std::map<const Attachment*, Part>& all() const { return parts_; }

  std::size_t memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& [item, part] : parts_) bytes += part.memory_bytes();
    return bytes;
  }

 private:
  std::map<const Attachment*, Part> parts_;
};

}  // namespace crowdface
