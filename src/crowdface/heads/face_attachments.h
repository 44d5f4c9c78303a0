// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/attach/attachment_carrier.h"
#include "crowdface/attach/shape_bend.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// An attachment placed on a face.
struct PlacedAttachment {
  const Attachment* item;            ///< the placed attachment
  std::optional<HairColour> colour;  ///< nothing if the face does not colour the attachment
  Positions positions;               ///< the attachment's vertices on the face
  /// displacements of the attachment's vertices, one item for each shape (expression) of the face
  std::vector<Displacements> moves = {};
  /// for a body with a separate texture for each face: the face's id; otherwise empty
  std::string face_id = {};
  /// for a body with a separate texture for each face: the texture as a PNG file; otherwise empty
  std::string_view texture_png = {};

  /// The attachment with its colour.
  ColouredAttachment look() const { return {item, colour}; }
};

/// Places attachments on faces. Each mesh is bound to the fitted head once, even if several
/// attachments share it with different colours.
class FaceAttachments {
 public:
  /// Makes an object without bound attachments; call `bind` before attachments_of.
  /// \param config, inputs  must outlive this object.
  FaceAttachments(const Config& config, const Inputs& inputs);
  /// Binds the attachments that these faces wear. \param config, inputs  must outlive this object.
  FaceAttachments(const Config& config, const Inputs& inputs, std::span<const FacePlan> faces);

  /// Binds the attachments that these faces wear, unless they are already bound.
  void bind(std::span<const FacePlan> faces);

  /// Places the attachments of a face, in the order of the face's recipe. The attachments must be
  /// bound. The result refers to the Inputs of this object.
  /// \param positions  the face's vertices, #V by 3
  /// \param moves      displacements of the face's vertices, one item for each shape (expression)
  ///                   of the Inputs; empty: the face at rest
  std::vector<PlacedAttachment> attachments_of(const FacePlan& face, const Positions& positions,
                                               std::span<const Displacements> moves = {}) const;

  /// Memory of this object, in bytes.
  std::size_t memory_bytes() const;
  /// Maximum memory that `attachments_of` needs for the meshes of one face, in bytes.
  std::size_t placement_memory_bytes() const;

 private:
  /// The mesh of one or more attachments, bound to the skin of the head to which the attachments
  /// were fitted.
  struct BoundMesh {
    const Attachment* item;  ///< the first attachment of the inputs that has this mesh
    /// moves the mesh from the fitted head to a face
    std::unique_ptr<const AttachmentCarrier> carrier;
    /// bends the mesh in expressions; null for a rigid attachment, or if the inputs have no shapes
    std::unique_ptr<const ShapeBend> bend;
  };

  const Config& config_;
  const Inputs& inputs_;
  /// skin of the head to which the attachments were fitted; null until `bind` has bound an
  /// attachment
  std::unique_ptr<const FittedSkin> skin_;
  std::vector<BoundMesh> bound_meshes_;  ///< all bound meshes, without duplicates
  /// for each attachment of the inputs: the index of its mesh in `bound_meshes_`; nothing if the
  /// mesh is not bound
  std::vector<std::optional<std::size_t>> mesh_of_item_;
};

}  // namespace crowdface
