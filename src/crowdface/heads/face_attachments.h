// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "crowdface/attach/attachment_carrier.h"
#include "crowdface/attach/shape_bend.h"
#include "crowdface/cast/cast_face.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// An attachment on a face.
struct WornAttachment {
  const Attachment* item;
  Positions positions;                    ///< of its own vertices
  std::vector<Displacements> moves = {};  ///< of those, in each of the face's shapes
};

/// The attachments of faces: what is bound to the fitted mesh is bound once, whatever colours one mesh comes in.
class FaceAttachments {
 public:
  /// For all items. \param inputs  must outlive this object.
  FaceAttachments(const Config& config, const Inputs& inputs);
  /// For no more than these faces wear.
  FaceAttachments(const Config& config, const Inputs& inputs, std::span<const CastFace> faces);

  /// What a face wears, in the order of its recipe; refers to the inputs.
  /// \param positions  of the face, #V by 3.
  /// \param moves      of the face, in each of the inputs' shapes; none: it is at rest.
  std::vector<WornAttachment> worn_by(const CastFace& face, const Positions& positions,
                                      std::span<const Displacements> moves = {}) const;

  /// What this object takes, and what the attachments of one face take at most.
  std::size_t memory_bytes() const;
  std::size_t worn_bytes() const;

 private:
  /// A mesh bound to the fitted one.
  struct Bound {
    std::unique_ptr<const AttachmentCarrier> carrier;
    std::unique_ptr<const ShapeBend> bend;  ///< if it bends and there are shapes
  };
  void bind(const Config& config, const std::vector<bool>& wanted);

  const Inputs& inputs_;
  std::unique_ptr<const FittedSkin> skin_;  ///< none: there are no attachments
  std::vector<Bound> bound_;
  std::vector<std::size_t> of_item_;  ///< #items rows of `bound_`
};

}  // namespace crowdface
