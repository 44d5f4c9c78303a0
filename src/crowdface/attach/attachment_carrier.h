// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/attach/attachment_move.h"
#include "crowdface/attach/fitted_skin.h"
#include "crowdface/attach/rigid_seat.h"
#include "crowdface/attach/skin_gaps.h"
#include "crowdface/attach/smooth_bend.h"

namespace crowdface {

/// Carries one attachment to faces. What depends on the fitted mesh alone is found once.
class AttachmentCarrier {
 public:
  /// \param skin      must outlive this object.
  /// \param topology  of the attachment.
  /// \param points    #P by 3, beside the fitted mesh; must outlive this object.
  AttachmentCarrier(const FittedSkin& skin, const Topology& topology, const Positions& points,
                    AttachmentMove move);

  /// The attachment's vertices on a face. What was off the skin stays off it: what bends to the gap
  /// that it had, if that was narrow, or else to two millimetres, what is rigid as far as moving it as
  /// a whole can do that.
  /// \param face     #V by 3, in the topology of the fitted mesh.
  /// \param normals  of the face, from FittedSkin::normals.
  Positions carry(const Positions& face, const Positions& normals) const;

  std::size_t memory_bytes() const;

 private:
  std::unique_ptr<const SkinGaps> gaps_;
  std::unique_ptr<const SmoothBend> bend_;  ///< one of the two
  std::unique_ptr<const RigidSeat> seat_;
};

}  // namespace crowdface
