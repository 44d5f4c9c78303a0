// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/face_attachments.h"

#include <algorithm>
#include <map>
#include <string>

#include "crowdface/core/parallel.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/named_parts.h"

namespace crowdface {

namespace {

/// Whether two attachments have the same vertices and polygons, and follow the skin in the same
/// way. Their materials may differ.
bool equal_meshes(const Attachment& a, const Attachment& b) {
  const Topology &one = a.file.topology, &other = b.file.topology;
  return a.moves == b.moves && a.file.positions.rows() == b.file.positions.rows() &&
         one.face_offsets == other.face_offsets && one.corner_vertices == other.corner_vertices &&
         a.file.positions == b.file.positions;
}

}  // namespace

FaceAttachments::FaceAttachments(const Config& config, const Inputs& inputs)
    : config_(config), inputs_(inputs), mesh_of_item_(inputs.attachments.items.size()) {}

FaceAttachments::FaceAttachments(const Config& config, const Inputs& inputs,
                                 std::span<const FacePlan> faces)
    : FaceAttachments(config, inputs) {
  bind(faces);
}

void FaceAttachments::bind(std::span<const FacePlan> faces) {
  const AttachmentSet& set = inputs_.attachments;
  std::vector<bool> is_wanted(set.items.size());
  for (const FacePlan& face : faces) {
    for (const std::string& name : face.attachments) is_wanted[set.index(name)] = true;
  }
  const std::size_t first_new = bound_meshes_.size();
  for (std::size_t i = 0; i < set.items.size(); ++i) {
    if (!is_wanted[i] || mesh_of_item_[i]) continue;
    const auto known = std::ranges::find_if(bound_meshes_, [&](const BoundMesh& mesh) {
      return equal_meshes(*mesh.item, set.items[i]);
    });
    mesh_of_item_[i] = static_cast<std::size_t>(known - bound_meshes_.begin());
    if (known == bound_meshes_.end()) bound_meshes_.push_back({&set.items[i], nullptr, nullptr});
  }
  if (bound_meshes_.size() == first_new) return;
  if (skin_ == nullptr) {
    skin_ =
        std::make_unique<const FittedSkin>(inputs_.head_set.topology, set.fitted_head_positions,
                                           skin_vertices(inputs_), 1 / mm_per(config_.faces.units));
  }
  parallel_for_each(bound_meshes_.size() - first_new, [&](std::size_t m) {
    BoundMesh& mesh = bound_meshes_[first_new + m];
    const ObjFile& file = mesh.item->file;
    mesh.carrier = std::make_unique<const AttachmentCarrier>(*skin_, file.topology, file.positions,
                                                             mesh.item->moves);
    if (inputs_.shapes.shapes.empty() || mesh.item->moves != AttachmentMove::kBend) return;
    mesh.bend =
        std::make_unique<const ShapeBend>(*skin_, inputs_.adjacency, file.topology, file.positions);
  });
}

std::vector<PlacedAttachment> FaceAttachments::attachments_of(
    const FacePlan& face, const Positions& positions, std::span<const Displacements> moves) const {
  std::vector<PlacedAttachment> placed;
  if (face.attachments.empty() || skin_ == nullptr) return placed;
  const Positions normals = skin_->normals(positions);
  for (const ColouredAttachment& coloured : inputs_.attachments.attachments_of(face)) {
    const BoundMesh& bound =
        bound_meshes_[mesh_of_item_[inputs_.attachments.index(coloured.item->name)].value()];
    placed.push_back(
        {coloured.item, coloured.colour, bound.carrier->move_to_face(positions, normals)});
    PlacedAttachment& one = placed.back();
    for (const Displacements& shape : moves) {
      one.moves.push_back(bound.bend
                              ? bound.bend->shape_displacements(positions, one.positions, shape)
                              : Displacements{{}, Positions(0, 3)});
    }
  }
  return placed;
}

std::size_t FaceAttachments::memory_bytes() const {
  std::size_t bytes = 0;
  for (const BoundMesh& bound : bound_meshes_) {
    bytes += bound.carrier->memory_bytes() + (bound.bend ? bound.bend->memory_bytes() : 0);
  }
  return bytes;
}

/// Adds up, for each kind of attachment, the memory for the largest attachment of the kind. A face
/// wears at most one attachment of each kind.
std::size_t FaceAttachments::placement_memory_bytes() const {
  // While an attachment is placed, up to three copies of its mesh are in memory at once: after
  // bending, and before and after a step that pushes the mesh off the skin.
  constexpr std::size_t kCopies = 3;
  std::map<std::string, std::size_t> largest;
  for (const Attachment& item : inputs_.attachments.items) {
    std::size_t& most = largest[item.kind];
    most = std::max(most, static_cast<std::size_t>(item.file.positions.size()) * sizeof(double));
  }
  std::size_t bytes = 0;
  for (const auto& [kind, most] : largest) bytes += kCopies * most;
  return bytes;
}

}  // namespace crowdface
