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

FaceAttachments::FaceAttachments(const Config& config, const Inputs& inputs) : inputs_(inputs) {
  bind_meshes(config, std::vector<bool>(inputs.attachments.items.size(), true));
}

FaceAttachments::FaceAttachments(const Config& config, const Inputs& inputs,
                                 std::span<const FacePlan> faces)
    : inputs_(inputs) {
  std::vector<bool> is_wanted(inputs.attachments.items.size());
  for (const FacePlan& face : faces) {
    for (const std::string& name : face.attachments) {
      is_wanted[inputs.attachments.index(name)] = true;
    }
  }
  bind_meshes(config, is_wanted);
}

void FaceAttachments::bind_meshes(const Config& config, const std::vector<bool>& is_wanted) {
  const AttachmentSet& set = inputs_.attachments;
  std::vector<const Attachment*> meshes;
  mesh_of_item_.resize(set.items.size());
  for (std::size_t i = 0; i < set.items.size(); ++i) {
    if (!is_wanted[i]) continue;
    const auto known = std::ranges::find_if(
        meshes, [&](const Attachment* mesh) { return equal_meshes(*mesh, set.items[i]); });
    mesh_of_item_[i] = static_cast<std::size_t>(known - meshes.begin());
    if (known == meshes.end()) meshes.push_back(&set.items[i]);
  }
  if (meshes.empty()) return;
  skin_ =
      std::make_unique<const FittedSkin>(inputs_.head_set.topology, set.fitted_head_positions,
                                         skin_vertices(inputs_), 1 / mm_per(config.faces.units));
  bound_meshes_.resize(meshes.size());
  parallel_for_each(meshes.size(), [&](std::size_t m) {
    const ObjFile& file = meshes[m]->file;
    bound_meshes_[m].carrier = std::make_unique<const AttachmentCarrier>(
        *skin_, file.topology, file.positions, meshes[m]->moves);
    if (inputs_.shapes.shapes.empty() || meshes[m]->moves != AttachmentMove::kBend) return;
    bound_meshes_[m].bend =
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
        bound_meshes_[mesh_of_item_[inputs_.attachments.index(coloured.item->name)]];
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
  // Three copies of a mesh are in memory at once: the bent mesh, and the mesh before and after it
  // is pushed off the skin.
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
