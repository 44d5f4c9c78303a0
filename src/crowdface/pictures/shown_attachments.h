// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/core/lazy_map.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/preview/packed_face.h"
#include "crowdface/preview/preview_mesh.h"
#include "crowdface/render/attachment_mesh.h"

namespace crowdface {

/// Attachments for the web pages. The reduced triangles and textures of an attachment are encoded
/// once; each face only adds positions. Thread-safe.
class ShownAttachments {
 public:
  /// Returns the triangles and materials of an attachment as JSON. This JSON is the same for all
  /// faces.
  std::string appearance_as_json(const ColouredAttachment& look,
                                 const AttachmentSurface& surface) const;
  /// Returns JSON with an attachment's vertex positions on a face (16 bits per coordinate),
  /// material by material. For each shape of the face, the JSON also has the vertices that the
  /// shape moves, and the displacements of these vertices.
  /// \param min_displacement  shortest displacement to store, in the unit of the positions
  std::string positions_as_json(const PlacedAttachment& placed, const PackingGrid& frame,
                                double min_displacement) const;
  /// An attachment's vertex positions on a face, three numbers per vertex.
  std::vector<float> vertex_positions(const PlacedAttachment& placed) const;

 private:
  /// One mesh per material. A mesh has no triangles if no polygon has its material.
  using MaterialMeshes = std::vector<PreviewMesh>;
  /// Returns the reduced meshes of an attachment. The first call computes and stores them.
  const MaterialMeshes& material_meshes(const Attachment& item) const;

  mutable LazyMap<const Attachment*, MaterialMeshes> meshes_;
};

}  // namespace crowdface
