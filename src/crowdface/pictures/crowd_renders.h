// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crowdface/cast/likeness.h"
#include "crowdface/config/config.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/pictures/attachment_surfaces.h"
#include "crowdface/pictures/gallery.h"
#include "crowdface/pictures/pictured_mesh.h"
#include "crowdface/render/camera.h"
#include "crowdface/render/face_renderer.h"

namespace crowdface {

class CrowdRenders;

/// The inputs for pictures of a crowd whose faces are already rendered. All referenced objects must
/// outlive this object.
struct PicturedCrowd {
  const Config& config;  ///< the config of the crowd, which must ask for contact sheets
  const Inputs& inputs;
  const CrowdDirectory& directory;
  const CrowdRenders& renders;
  const FaceShapes& shapes;  ///< expressions of the faces
  const std::vector<FacePlan>& faces;
  const Likeness& likeness;
};

/// The files made for the pictures of one face, as bytes.
struct FacePictures {
  std::string png;  ///< PNG file of all views, side by side
  /// the face's script for the gallery, from GalleryMeshes; empty without a gallery
  std::optional<std::string> gallery_script;
};

/// Renders the faces of a crowd. Each view has one camera for all faces, fitted to the input heads,
/// so that images show faces at the same scale. Thread-safe, except add_gallery.
class CrowdRenders {
 public:
  /// \param inputs    must outlive this object.
  /// \param textures  provide the body's texture; null: images do not show the body. Must outlive
  ///   this object.
  CrowdRenders(const Config& config, const Config::ContactSheet& sheet, const Inputs& inputs,
               const FaceTextures* textures = nullptr);

  /// Enables gallery meshes. After this call, `render_files` also makes the gallery script of a
  /// face.
  /// \param meshes  must outlive this object.
  void add_gallery(const GalleryMeshes& meshes) { gallery_ = &meshes; }
  /// Whether `render_files` needs the blend shapes of a face.
  bool needs_shapes() const { return gallery_ != nullptr; }

  const PicturedMesh& mesh() const { return mesh_; }
  const AttachmentSurfaces& attachment_surfaces() const { return attachment_surfaces_; }

  /// Renders a face and makes its gallery script.
  /// \param target        the head whose textures the face shows if `face_textures` is null.
  /// \param positions     in single precision, as in mesh files.
  /// \param moves         displacements of each shape, for the gallery.
  /// \param face_textures  the textures blended for this face, from face_texture_set, or null.
  /// \param placed        the attachments that the face wears.
  /// \param colours       vertex colours, shown if there are no textures; may have no rows.
  /// \param body          texture of the body, or null.
  FacePictures render_files(const std::string& id, Index target, const Positions& positions,
                            std::span<const Displacements> moves,
                            const FaceTextureSet* face_textures,
                            const std::vector<PlacedAttachment>& placed = {},
                            const ColourRows& colours = {},
                            const BlendedPicture* body = nullptr) const;
  /// Returns the content of a head's script for the gallery page, see GalleryMeshes::face_script.
  std::string gallery_script_of_head(Index head, std::span<const Displacements> moves) const;

  /// Textures of a head; nothing if the head has no textures or if textures are not shown.
  std::optional<TextureSet> texture_set_of(Index head) const;
  /// Vertex colours of a head; nothing if the head has no vertex colours or if textures replace
  /// them.
  std::optional<VertexColours> colours_of(Index head, const TextureSet* texture_set) const;
  /// Returns an empty texture set, to which the caller adds the face's blended textures. Returns
  /// nothing if textures are not blended or not shown.
  std::optional<FaceTextureSet> face_texture_set(Index target) const;
  /// Blends the face's textures and returns them as a texture set.
  std::optional<FaceTextureSet> face_texture_set(const FaceTextures& textures,
                                                 const Recipe& recipe) const;

  /// Renders all views of a face side by side, as the bytes of a PNG file.
  std::string render_png(const Positions& positions, const FaceTextures& textures,
                         const Recipe& recipe) const;
  /// \param head  the head whose textures the face shows, if the head has any.
  std::string render_png(const Positions& positions, Index head) const;
  /// \param colours  vertex colours; if null, each surface has its own colour.
  /// \param texture_set  textures, or null.
  /// \param body         texture of the body, or null.
  std::string render_png(const Positions& positions, const VertexColours* colours,
                         const TextureSet* texture_set = nullptr,
                         const std::vector<PlacedAttachment>& placed = {},
                         const BlendedPicture* body = nullptr) const;
  const std::vector<Camera>& cameras() const { return cameras_; }
  /// Renders one view. \param camera  one of cameras().
  Rgb8Image render(const Positions& positions, const Camera& camera) const {
    return renderer_.render(positions, camera, nullptr);
  }
  /// Renders only the first view.
  Rgb8Image render_front(const Positions& positions, const VertexColours* colours = nullptr) const;

 private:
  /// The body's texture for a recipe; nothing if the rendered images do not show the body.
  std::optional<BlendedPicture> blend_body_texture(const Recipe& recipe) const;

  PicturedMesh mesh_;
  const FaceTextures* textures_;
  std::vector<Camera> cameras_;  ///< the camera of each view
  FaceRenderer renderer_;
  const Inputs& inputs_;
  bool shows_textures_;
  int max_texels_;  ///< largest width and height of a texture in rendered images
  AttachmentSurfaces attachment_surfaces_;
  /// the gallery's meshes, for `render_files`; null: render_files makes no gallery scripts
  const GalleryMeshes* gallery_ = nullptr;
};

/// Reads a rendered image from the crowd's folder. \throws MissingInput, InvalidInput.
Rgb8Image read_render(const std::filesystem::path& path);

}  // namespace crowdface
