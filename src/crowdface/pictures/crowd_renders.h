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
#include "crowdface/pictures/gallery.h"
#include "crowdface/pictures/worn_surfaces.h"
#include "crowdface/render/camera.h"
#include "crowdface/render/face_renderer.h"

namespace crowdface {

class CrowdRenders;

/// A crowd whose pictures lie in its folder. What it refers to must outlive it.
struct PicturedCrowd {
  const Config& config;  ///< with contact sheets
  const Inputs& inputs;
  const CrowdDirectory& directory;
  const CrowdRenders& renders;
  const FaceShapes& shapes;
  const std::vector<CastFace>& faces;
  const Likeness& likeness;
};

/// What is shown of one face: files' bytes.
struct FacePictures {
  std::string picture;                 ///< PNG
  std::optional<std::string> preview;  ///< for the gallery, if there is one
};

/// Pictures of one crowd: one camera a view, fitted once to the input heads, so that sizes compare.
class CrowdRenders {
 public:
  /// \param inputs  must outlive this object.
  CrowdRenders(const Config& config, const Config::ContactSheet& sheet, const Inputs& inputs);

  /// From now on `draw` makes a face's mesh for the gallery, too. Must outlive this object.
  void add_gallery(const GalleryMeshes& meshes) { gallery_ = &meshes; }
  /// Whether `draw` needs a face's shapes.
  bool show_shapes() const { return gallery_ != nullptr; }

  const WornSurfaces& worn_surfaces() const { return worn_surfaces_; }

  /// A face's picture, and what the gallery shows of it.
  /// \param positions  in single precision, as mesh files hold them.
  /// \param moves     its displacements in each shape, if they are shown.
  /// \param own       of own_coat, or null: it bears its target's textures, if there are any.
  /// \param worn      its attachments.
  /// \param colours   at its vertices, shown if it bears no textures; or no rows.
  FacePictures draw(const std::string& id, Index target, const Positions& positions,
                    std::span<const Displacements> moves, const OwnCoat* own,
                    const std::vector<WornAttachment>& worn = {},
                    const ColourRows& colours = {}) const;

  /// What a head wears in pictures; nothing if it has no texture, or none is shown.
  std::optional<TextureCoat> coat_of(Index head) const;
  /// To be given the own pictures of a face; nothing if none are shown.
  std::optional<OwnCoat> own_coat(Index target) const;
  /// The same with the pictures of a face.
  std::optional<OwnCoat> own_coat(const FaceTextures& textures, const Recipe& recipe) const;

  /// All views of a face side by side, as a PNG file's bytes.
  std::string render_png(const Positions& positions, const FaceTextures& textures,
                         const Recipe& recipe) const;
  /// \param head  whose texture it bears, if there are textures.
  std::string render_png(const Positions& positions, Index head) const;
  /// \param colours  of the vertices, or null: those of the surfaces.
  /// \param coat     its textures, or null.
  std::string render_png(const Positions& positions, const VertexColours* colours,
                         const TextureCoat* coat = nullptr,
                         const std::vector<WornAttachment>& worn = {}) const;
  /// The first of the views alone.
  Rgb8Image render_front(const Positions& positions, const VertexColours* colours = nullptr) const;

 private:
  std::vector<Camera> cameras_;
  FaceRenderer renderer_;
  const Inputs& inputs_;
  bool textured_;
  int most_texels_;
  WornSurfaces worn_surfaces_;
  const GalleryMeshes* gallery_ = nullptr;
};

/// A picture written earlier, read back. \throws MissingInput, InvalidInput.
Rgb8Image read_render(const std::filesystem::path& path);

}  // namespace crowdface
