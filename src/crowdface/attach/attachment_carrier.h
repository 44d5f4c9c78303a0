// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/attach/attachment_move.h"
#include "crowdface/attach/fitted_skin.h"
#include "crowdface/attach/rigid_placement.h"
#include "crowdface/attach/skin_gaps.h"
#include "crowdface/attach/smooth_bend.h"

namespace crowdface {

/// Carries one attachment from the fitted mesh to faces. The fitted mesh is the head to which the
/// attachment was fitted. The constructor computes everything that depends on the fitted mesh only.
class AttachmentCarrier {
 public:
  /// \param skin      Skin of the fitted mesh; must outlive this object.
  /// \param topology  Topology of the attachment.
  /// \param points    #P by 3. Vertices of the attachment on the fitted mesh; must outlive this
  ///                  object.
  /// \param move      How the attachment follows the skin: rigidly or by bending.
  AttachmentCarrier(const FittedSkin& skin, const Topology& topology, const Positions& points,
                    AttachmentMove move);

  /// Returns the positions of the attachment's vertices on a face. Vertices that were outside the
  /// skin of the fitted mesh stay outside. A vertex's gap is its distance from the skin. On a
  /// bending attachment, a gap of at most 2 mm on the fitted mesh gets the same width on the face;
  /// a wider gap stays at least 2 mm wide. A rigid attachment moves as a whole, so it keeps its
  /// gaps only approximately.
  ///
  /// \param face     #V by 3, in the topology of the fitted mesh.
  /// \param normals  Normals of the face, from FittedSkin::normals.
  /// \return         #P by 3, where #P is the number of the attachment's vertices.
  Positions move_to_face(const Positions& face, const Positions& normals) const;

  std::size_t memory_bytes() const;

 private:
  /// distances of the attachment's vertices from the skin of the fitted mesh
  std::unique_ptr<const SkinGaps> gaps_;
  /// moves the vertices of a bending attachment; null if the attachment is rigid
  std::unique_ptr<const SmoothBend> bend_;
  /// moves the vertices of a rigid attachment; null if the attachment bends
  std::unique_ptr<const RigidPlacement> rigid_placement_;
};

}  // namespace crowdface
