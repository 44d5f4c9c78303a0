// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "crowdface/run/mesh_level.h"

namespace crowdface {

/// The attachments of a crowd in the form in which files on one level have them: all whole, or those that a face
/// wears on a level of detail.
/// \tparam Form  is made once for an attachment, and written with the positions on each face.
template <class Form>
class AttachmentForms {
 public:
  /// \param make  the form of an attachment; its level of detail is null if the attachment is whole.
  template <class Make>
  AttachmentForms(const AttachmentSet& set, const MeshLevel& level, const Make& make) {
    for (const Attachment* item : level.items(set)) {
      forms_.emplace(item, make(*item, level.find(*item)));
    }
  }

  const Form& at(const Attachment& item) const { return forms_.at(&item); }
  /// What a face wears; refers to both. \tparam Placed  a form, positions and moves.
  template <class Placed>
  std::vector<Placed> placed(std::span<const WornAttachment> worn) const {
    std::vector<Placed> placed;
    for (const WornAttachment& one : worn) {
      placed.push_back({&forms_.at(one.item), &one.positions, one.moves});
    }
    return placed;
  }

  std::size_t memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& [item, form] : forms_) bytes += std::invoke(&Form::memory_bytes, form);
    return bytes;
  }
  /// What encoding takes of what one face wears at most: one attachment of each kind.
  /// \param files  in how many files an attachment stands
  template <class Files>
  std::size_t encode_bytes(const Files& files) const {
    std::map<std::string, std::size_t> largest;
    for (const auto& [item, form] : forms_) {
      std::size_t& most = largest[item->kind];
      most = std::max(
          most, std::invoke(&Form::encode_bytes, form) * static_cast<std::size_t>(files(*item)));
    }
    std::size_t sum = 0;
    for (const auto& [kind, most] : largest) sum += most;
    return sum;
  }
  std::size_t encode_bytes() const {
    return encode_bytes([](const Attachment&) { return 1U; });
  }

 private:
  std::map<const Attachment*, Form> forms_;
};

/// The form of the faces' mesh, and those of the attachments in the same file.
template <class Mesh, class Part>
struct DressedForm {
  Mesh mesh;
  AttachmentForms<Part> parts;

  std::size_t memory_bytes() const { return mesh.memory_bytes() + parts.memory_bytes(); }
  std::size_t encode_bytes() const { return mesh.encode_bytes() + parts.encode_bytes(); }
};

}  // namespace crowdface
