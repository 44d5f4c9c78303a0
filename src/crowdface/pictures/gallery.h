// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/pictures/shown_attachments.h"
#include "crowdface/pictures/vertex_finish.h"
#include "crowdface/pictures/worn_surfaces.h"
#include "crowdface/preview/packed_face.h"
#include "crowdface/preview/preview_mesh.h"
#include "crowdface/render/texture.h"
#include "crowdface/render/vertex_colours.h"
#include "crowdface/shapes/shape_set.h"

namespace crowdface {

/// The meshes of a gallery: reduced, and packed into scripts, because a page opened from disk may
/// load nothing else. What all faces share is prepared once.
class GalleryMeshes {
 public:
  /// \param inputs  must outlive this object.
  GalleryMeshes(const Config& config, const Inputs& inputs);

  /// data/mesh.js: triangles, colours, texture coordinates, the frame of the positions.
  std::string shared_script() const;
  /// data/faces/NAME.js or data/heads/NAME.js.
  /// \param moves  the face's displacements in each shape.
  /// \param coat   the face's textures, or null: it has the colours that all share.
  /// \param worn   its attachments.
  std::string face_script(const std::string& name, const Positions& positions,
                          std::span<const Displacements> moves, const TextureCoat* coat,
                          const std::vector<WornAttachment>& worn = {}) const;
  /// data/attachments/NAME.js
  std::string attachment_script(const std::string& name, const WornSurfaces& surfaces) const;

 private:
  /// Colours as the page shows them, three bytes a vertex, darker where little light arrives.
  std::string shades(const VertexColours& colours) const;
  /// A coat's pictures, and which of them each look of the reduced mesh shows, as JSON.
  std::string skin(const TextureCoat& coat) const;
  /// A byte a vertex; of a coat without roughness none.
  std::string roughness(const TextureCoat& coat) const;
  double least_move() const;
  void add_shapes(const Surfaces& surfaces, const Positions& mean);
  std::string packed_shapes(std::span<const Displacements> carried) const;

  const Config& config_;
  const Inputs& inputs_;
  PreviewMesh mesh_;
  FacesAround around_;
  PackingFrame frame_;
  ShownAttachments attachments_;
  VertexColours colours_;    ///< of the surfaces themselves, one a vertex of the reduced mesh
  std::vector<float> open_;  ///< how much light arrives there, on the mean head
  std::vector<TexturePlace> places_;  ///< #vertices in textures; or empty: there are none
  Eigen::Vector3d low_, high_;        ///< of the heads' boxes

  /// What the reduced mesh has of a shape's vertices.
  struct ShownMoves {
    std::vector<std::uint32_t> rows;      ///< of the shape's displacements
    std::vector<std::uint32_t> vertices;  ///< of the reduced mesh
  };
  std::vector<ShownMoves> shown_;      ///< #shapes
  std::size_t widest_ = 0;             ///< the shape that moves most: a jaw that opens
  std::vector<float> open_in_widest_;  ///< as `open_`, in that shape
};

}  // namespace crowdface
