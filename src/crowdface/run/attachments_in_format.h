// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "crowdface/io/part_look.h"
#include "crowdface/run/mesh_level.h"

namespace crowdface {

/// The attachments of a crowd at one level of detail, converted for one file format.
/// \tparam FormatData  the part of an attachment's file that is equal for all faces. An encoded
///                     file combines this part with the attachment's positions on one face.
template <class FormatData>
class AttachmentsInFormat {
 public:
  /// \param make  make(attachment, level) returns the FormatData of an attachment; `level` is the
  ///              attachment's level of detail, or null if the attachment is not reduced.
  template <class Make>
  AttachmentsInFormat(const AttachmentSet& set, const MeshLevel& level, const Make& make) {
    for (const Attachment* item : level.attachments_in_files(set)) {
      data_of_attachment_.emplace(item, make(*item, level.find(*item)));
    }
  }

  const FormatData& at(const Attachment& item) const { return data_of_attachment_.at(&item); }
  /// Combines a face's attachments with their data in this format. The result refers to
  /// `attachments` and to this object.
  /// \tparam Placed  a struct with a pointer to FormatData, positions, displacements and a PartLook
  template <class Placed>
  std::vector<Placed> placed(std::span<const PlacedAttachment> attachments) const {
    std::vector<Placed> placed;
    for (const PlacedAttachment& one : attachments) {
      const ColouredAttachment look = one.look();
      const std::string name = one.face_id.empty() ? look.label() : one.face_id;
      placed.push_back({&data_of_attachment_.at(one.item), &one.positions, one.moves,
                        PartLook{look.tint(), name, one.texture_png}});
    }
    return placed;
  }

  /// Memory of the converted attachments, in bytes.
  std::size_t memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& [item, format_data] : data_of_attachment_)
      bytes += std::invoke(&FormatData::memory_bytes, format_data);
    return bytes;
  }
  /// Maximum memory, in bytes, for encoding the attachments of one face. A face wears at most one
  /// attachment of each kind.
  /// \param files  files(attachment) returns the number of the face's files that contain this
  ///               attachment
  template <class Files>
  std::size_t encoding_memory_bytes(const Files& files) const {
    std::map<std::string, std::size_t> max_bytes_by_kind;
    for (const auto& [item, format_data] : data_of_attachment_) {
      std::size_t& most = max_bytes_by_kind[item->kind];
      most = std::max(most, std::invoke(&FormatData::encoding_memory_bytes, format_data) *
                                static_cast<std::size_t>(files(*item)));
    }
    std::size_t bytes = 0;
    for (const auto& [kind, most] : max_bytes_by_kind) bytes += most;
    return bytes;
  }
  /// Like the overload with `files`, but for a format in which each attachment of a face is
  /// contained in exactly one of the face's files.
  std::size_t encoding_memory_bytes() const {
    return encoding_memory_bytes([](const Attachment&) { return 1U; });
  }

 private:
  std::map<const Attachment*, FormatData> data_of_attachment_;  ///< the data of each attachment
};

/// The mesh and the attachments of a crowd, converted for one file format. Holds only data that are
/// equal for all faces.
template <class Mesh, class Part>
struct MeshWithAttachments {
  /// the data that the meshes of all faces have in common: topology, texture coordinates, materials
  Mesh mesh;
  AttachmentsInFormat<Part> parts;  ///< one part for each attachment

  /// Memory of the mesh and the attachments, in bytes.
  std::size_t memory_bytes() const { return mesh.memory_bytes() + parts.memory_bytes(); }
  /// Maximum memory, in bytes, for encoding the mesh and the attachments of one face.
  std::size_t encoding_memory_bytes() const {
    return mesh.encoding_memory_bytes() + parts.encoding_memory_bytes();
  }
};

}  // namespace crowdface
