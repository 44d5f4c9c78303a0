// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/core/grouped.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// The mesh of all faces, and of what they wear, whole or on a level of detail. Of each attachment a level has the
/// share of triangles that faces keep there, but no fewer than 300, so that what is small stays whole.
struct MeshLevel {
  std::size_t number = 0;                                ///< 0: whole
  const DetailLevel* face = nullptr;                     ///< null: whole
  std::map<const Attachment*, DetailLevel> attachments;  ///< that a face wears; none: whole

  bool whole() const { return face == nullptr; }
  const Topology& topology(const Inputs& inputs) const {
    return whole() ? inputs.faces.topology : face->topology;
  }
  const TextureCoordinates& uvs(const Inputs& inputs) const {
    return whole() ? inputs.faces.uvs : face->uvs;
  }
  /// The attachments that files on this level may have: all, or those that a face wears.
  std::vector<const Attachment*> items(const AttachmentSet& set) const;
  /// How an attachment looks on this level; null: whole.
  const DetailLevel* find(const Attachment& item) const;
  /// What a face wears, reduced.
  std::vector<WornAttachment> of(std::span<const WornAttachment> worn) const;
};

/// "LOD2" after this, or nothing of the whole mesh.
inline std::string suffix_of(std::size_t level, std::string_view before) {
  return level == 0 ? std::string() : concat(before, "LOD", level);
}

/// What the faces or the vertices of a level are in the whole mesh. \param rows  of that.
template <class T>
std::vector<T> at_rows(const std::vector<T>& whole, std::span<const std::uint32_t> rows) {
  std::vector<T> some;
  for (const std::uint32_t row : rows) some.push_back(whole[row]);
  return some;
}
/// The same in groups; of none: none.
template <class T>
Grouped<T> at_rows(const Grouped<T>& whole, std::span<const std::uint32_t> rows) {
  Grouped<T> some;
  if (whole.group_count() == 0) return some;
  for (const std::uint32_t row : rows) some.add_group(whole.of(row));
  return some;
}

/// The whole mesh, then the inputs' levels of detail.
/// \param inputs  must outlive the result. \param crowd  who wears something.
std::vector<MeshLevel> mesh_levels(const Inputs& inputs, std::span<const CastFace> crowd);

}  // namespace crowdface
