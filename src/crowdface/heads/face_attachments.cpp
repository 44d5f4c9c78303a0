// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/face_attachments.h"

#include <algorithm>
#include <map>
#include <string>

#include "crowdface/core/parallel.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/named_parts.h"

namespace crowdface {

FaceAttachments::FaceAttachments(const Config& config, const Inputs& inputs) : inputs_(inputs) {
  const AttachmentSet& set = inputs.attachments;
  if (set.empty()) return;
  skin_ = std::make_unique<const FittedSkin>(inputs.faces.topology, set.fitted_to,
                                             skin_vertices(inputs), 1 / mm_per(config.faces.units));
  carriers_.resize(set.items.size());
  bends_.resize(set.items.size());
  parallel_for_each(carriers_.size(), [&](std::size_t i) {
    const ObjFile& file = set.items[i].file;
    carriers_[i] = std::make_unique<const AttachmentCarrier>(*skin_, file.topology, file.positions,
                                                             set.items[i].moves);
    if (inputs.shapes.shapes.empty() || set.items[i].moves != AttachmentMove::kBend) return;
    bends_[i] =
        std::make_unique<const ShapeBend>(*skin_, inputs.adjacency, file.topology, file.positions);
  });
}

std::vector<WornAttachment> FaceAttachments::worn_by(const CastFace& face,
                                                     const Positions& positions,
                                                     std::span<const Displacements> moves) const {
  std::vector<WornAttachment> worn;
  if (face.attachments.empty() || skin_ == nullptr) return worn;
  const Positions normals = skin_->normals(positions);
  for (const std::string& name : face.attachments) {
    const Attachment& item = inputs_.attachments.at(name);
    const auto i = static_cast<std::size_t>(&item - inputs_.attachments.items.data());
    worn.push_back({&item, carriers_[i]->carry(positions, normals)});
    WornAttachment& one = worn.back();
    for (const Displacements& shape : moves) {
      one.moves.push_back(bends_[i] ? bends_[i]->in_shape(positions, one.positions, shape)
                                    : Displacements{{}, Positions(0, 3)});
    }
  }
  return worn;
}

std::size_t FaceAttachments::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& carrier : carriers_) bytes += carrier->memory_bytes();
  for (const auto& bend : bends_) bytes += bend ? bend->memory_bytes() : 0;
  return bytes;
}

/// One of each kind is no more than all that there are.
std::size_t FaceAttachments::worn_bytes() const {
  constexpr std::size_t kCopies = 3;  // bent, pushed off the skin, before that
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
