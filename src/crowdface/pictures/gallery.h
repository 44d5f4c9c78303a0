// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/pictures/attachment_surfaces.h"
#include "crowdface/pictures/pictured_mesh.h"
#include "crowdface/pictures/shown_attachments.h"
#include "crowdface/pictures/vertex_roughness.h"
#include "crowdface/preview/packed_face.h"
#include "crowdface/preview/preview_mesh.h"
#include "crowdface/render/texture.h"
#include "crowdface/render/vertex_colours.h"
#include "crowdface/shapes/shape_set.h"

namespace crowdface {

/// The meshes of a gallery, reduced and encoded as scripts, because a web page opened from disk can
/// load scripts but no other files. The data that all faces share is computed once.
class GalleryMeshes {
 public:
  /// \param inputs, pictured_mesh  must outlive this object.
  GalleryMeshes(const Config& config, const Inputs& inputs, const PicturedMesh& pictured_mesh);

  /// Returns the content of data/mesh.js: triangles, colours, texture coordinates, and the
  /// quantization grid of packed positions.
  std::string shared_script() const;
  /// Returns the content of data/faces/NAME.js or data/heads/NAME.js: the data of one face or head.
  /// \param moves    displacements of each shape of the face.
  /// \param texture_set  textures of the face; if null, the face shows its vertex colours or the
  ///                     colours that all faces share.
  /// \param colours  vertex colours of the face, or null.
  /// \param placed   the attachments that the face wears.
  /// \param body     texture of the body, or null.
  std::string face_script(const std::string& name, const Positions& positions,
                          std::span<const Displacements> moves, const TextureSet* texture_set,
                          const VertexColours* colours,
                          const std::vector<PlacedAttachment>& placed = {},
                          const BlendedPicture* body = nullptr) const;
  /// Returns the content of data/attachments/NAME.js: the triangles and materials of an attachment.
  std::string attachment_script(const ColouredAttachment& look,
                                const AttachmentSurfaces& surfaces) const;

 private:
  /// Whether the page colours the body at its vertices instead of with a texture: if the config
  /// names no texture for the body.
  bool colours_body_at_vertices() const;
  Topology topology_to_split() const;
  void colour_body(const BlendedPicture& body, VertexColours& colours) const;
  /// Returns the vertex colours as three sRGB bytes per vertex.
  std::string pack_vertex_colours(const VertexColours& colours) const;
  /// Returns JSON with the textures of a layer and, for each material of the reduced mesh, the
  /// index of its texture.
  /// \param picture_of  encodes a texture as a data URL
  std::string textures_as_json(const TextureLayer& layer,
                               std::string (*picture_of)(const Texture&, int max_px)) const;
  /// Returns the roughness as one byte per vertex; empty if the set has no roughness maps.
  std::string pack_roughness(const TextureSet& texture_set) const;
  /// Returns the length below which displacements of shapes are omitted, in the unit of the mesh.
  double min_displacement() const;
  /// Computes `shown_shapes_`. Also finds the blend shape with the largest displacements, and
  /// computes the visible fraction of the sky at each vertex for this shape
  /// (`sky_visibility_in_shape_with_largest_motion_`).
  /// \param mean  positions of the mean face (and of the body), before reduction
  void add_shapes(const Surfaces& surfaces, const Positions& mean);
  /// Packs the displacements of the vertices in `shown_shapes_` (see pack_displacement).
  std::string pack_shapes(std::span<const Displacements> shape_moves) const;

  const Config& config_;
  const Inputs& inputs_;
  const PicturedMesh& pictured_mesh_;  ///< the mesh before reduction
  PreviewMesh mesh_;                   ///< the reduced mesh
  /// triangles of a coarser mesh, which uses the vertices of `mesh_`; see draft_triangles
  std::vector<std::uint32_t> draft_triangles_;
  VertexFaces vertex_faces_;  ///< the polygons around each vertex of the mesh before reduction
  PackingGrid packing_grid_;
  ShownAttachments attachments_;
  /// colours of surfaces without textures, per vertex of the reduced mesh
  VertexColours colours_;
  /// visible fraction of the sky at the vertices of the reduced mesh, on the mean head
  std::vector<float> sky_visibility_;
  /// for each vertex of the reduced mesh: its position in the heads' textures; empty if there are
  /// no textures
  std::vector<TexturePoint> texture_points_;
  Eigen::Vector3d box_min_, box_max_;  ///< bounding box of all heads and the shoulders of the body

  /// The vertices of the gallery's reduced mesh that a blend shape visibly moves.
  struct ShownShape {
    /// for each moved vertex: its row in the matrix of the shape's displacements
    std::vector<std::uint32_t> rows;
    std::vector<std::uint32_t> vertices;  ///< indices of the moved vertices in the reduced mesh
  };
  std::vector<ShownShape> shown_shapes_;  ///< one entry per blend shape
  /// index of the blend shape with the largest displacements, such as an open jaw
  std::size_t shape_with_largest_motion_ = 0;
  /// visible fraction of the sky at the vertices of the reduced mesh, on the mean head in the shape
  /// `shape_with_largest_motion_`
  std::vector<float> sky_visibility_in_shape_with_largest_motion_;
};

}  // namespace crowdface
