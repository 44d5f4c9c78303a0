// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/core/made_once.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/preview/packed_face.h"
#include "crowdface/preview/preview_mesh.h"
#include "crowdface/render/worn_mesh.h"

namespace crowdface {

/// Attachments on the pages: each one's triangles and pictures are told once, reduced, and of a face
/// the positions. Any thread may ask.
class ShownAttachments {
 public:
  /// What pages need to show one on any face, as JSON: for each material triangles and how it looks.
  std::string look(const Attachment& item, const WornSurface& surface) const;
  /// Positions on a face, as JSON, 16 bits a coordinate: the vertices of one material after the other; and
  /// how far the face's shapes move which of those.
  /// \param least  a move that is shown
  std::string packed(const WornAttachment& worn, const PackingFrame& frame, double least) const;
  /// The same as numbers, three a vertex.
  std::vector<float> points(const WornAttachment& worn) const;

 private:
  /// One a material; of no triangles if no face is of it.
  using Parts = std::vector<PreviewMesh>;
  const Parts& parts(const Attachment& item) const;

  mutable MadeOnce<const Attachment*, Parts> parts_;
};

}  // namespace crowdface
