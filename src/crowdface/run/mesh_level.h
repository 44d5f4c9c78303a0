// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/core/compressed_rows.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/given_normals.h"

namespace crowdface {

/// The topology that all faces share, and the topologies of attachments, either whole or reduced to
/// one level of detail. A level of detail keeps the same fraction of triangles in attachments as in
/// faces, but at least 300 triangles, so that small attachments stay whole.
struct MeshLevel {
  std::size_t level_number = 0;  ///< number of the level of detail; 0 is the whole mesh
  /// the reduced mesh that faces have at this level; null: the whole mesh
  const DetailLevel* face_level = nullptr;
  /// The reduced mesh of each attachment that any face wears. If files contain the body, the body
  /// is one of these attachments. Empty at level 0, where nothing is reduced.
  std::map<const Attachment*, DetailLevel> attachments;
  const Attachment* body = nullptr;  ///< the body; null if files do not contain the body

  /// Whether this is level 0, which is not reduced.
  bool is_whole_mesh() const { return face_level == nullptr; }
  /// The faces' topology at this level.
  const Topology& topology(const Inputs& inputs) const {
    return is_whole_mesh() ? inputs.head_set.topology : face_level->topology;
  }
  /// The faces' texture coordinates at this level.
  const TextureCoordinates& uvs(const Inputs& inputs) const {
    return is_whole_mesh() ? inputs.head_set.uvs : face_level->uvs;
  }
  /// Returns the attachments that files at this level may contain, including the body. Reduced
  /// levels contain only the body and attachments that some face wears.
  std::vector<const Attachment*> attachments_in_files(const AttachmentSet& set) const;
  /// The reduced attachment at this level; null if the attachment is whole.
  const DetailLevel* find(const Attachment& item) const;
  /// A face's attachments, reduced to this level.
  std::vector<PlacedAttachment> reduced_attachments(std::span<const PlacedAttachment> placed) const;
};

/// Returns `separator` followed by the name of the level, such as "LOD2". Empty for level 0,
/// the whole mesh.
inline std::string level_suffix(std::size_t level, std::string_view separator) {
  return level == 0 ? std::string() : concat(separator, "LOD", level);
}

/// Selects the values of a reduced mesh from the values of the whole mesh.
/// \param whole  one value for each polygon or vertex of the whole mesh
/// \param rows   for each polygon or vertex of the reduced mesh: an index into `whole`
template <class T>
std::vector<T> select_rows(const std::vector<T>& whole, std::span<const std::uint32_t> rows) {
  std::vector<T> selected;
  for (const std::uint32_t row : rows) selected.push_back(whole[row]);
  return selected;
}
/// Like the other overload of select_rows, but with several values for each polygon or vertex.
/// Returns an empty result if `whole` is empty.
template <class T>
CompressedRows<T> select_rows(const CompressedRows<T>& whole, std::span<const std::uint32_t> rows) {
  CompressedRows<T> selected;
  if (whole.group_count() == 0) return selected;
  for (const std::uint32_t row : rows) selected.add_group(whole.items_of(row));
  return selected;
}

/// Returns the whole mesh, then the mesh at each level of detail of the inputs.
/// \param inputs  must outlive the result.
/// \param crowd   faces, whose attachments the levels include
/// \param with_body  whether the levels include the body
std::vector<MeshLevel> mesh_levels(const Inputs& inputs, std::span<const FacePlan> crowd,
                                   bool with_body = false);

/// Returns the vertex normals of the body at the neck ring. All faces have the same normals there.
/// Returns an empty result if `item` is not the body.
/// \param level  the level of detail of the body; null: the whole body
GivenNormals normals_at_neck_ring(const Inputs& inputs, const Attachment& item,
                                  const DetailLevel* level);

}  // namespace crowdface
