// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/attachment_carrier.h"

namespace crowdface {

AttachmentCarrier::AttachmentCarrier(const FittedSkin& skin, const Topology& topology,
                                     const Positions& points, AttachmentMove move)
    : gaps_(std::make_unique<const SkinGaps>(skin, topology, points)) {
  if (move == AttachmentMove::kBend) {
    bend_ = std::make_unique<const SmoothBend>(skin, points);
  } else {
    rigid_placement_ = std::make_unique<const RigidPlacement>(skin, points, *gaps_);
  }
}

std::size_t AttachmentCarrier::memory_bytes() const {
  return gaps_->memory_bytes() + (bend_ ? bend_->memory_bytes() : 0);
}

Positions AttachmentCarrier::move_to_face(const Positions& face, const Positions& normals) const {
  if (rigid_placement_) return rigid_placement_->place(face, normals);
  Positions points = bend_->bend(face);
  gaps_->restore_gaps(face, normals, points);
  return points;
}

}  // namespace crowdface
