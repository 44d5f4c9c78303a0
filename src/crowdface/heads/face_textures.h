// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "crowdface/config/config.h"
#include "crowdface/heads/body_painter.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/heads/seam_colours.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface {

/// Names of the images that are made for each face: first the colour images, then the images of
/// each other kind.
std::vector<PictureName> face_picture_names(const Inputs& inputs);

/// Whether each face gets textures that are blended from the heads' textures.
inline bool blends_textures(const Inputs& inputs) {
  return inputs.textures.are_blended() || !inputs.other_textures.empty();
}

/// A recipe that gives a face exactly the colours of one input head.
Recipe recipe_of_head(Index head);

/// Blends the textures and vertex colours of a crowd's faces, and paints the body's texture for
/// each face.
class FaceTextures {
 public:
  /// \param inputs  must outlive this object.
  FaceTextures(const Config& config, const Inputs& inputs);
  /// Whether the program makes images for each face (see face_picture_names).
  bool has_textures() const { return !pictures_.empty(); }
  /// Number of images in face_picture_names.
  std::size_t picture_count() const { return pictures_.size(); }
  /// Blends a single image of a face, so that callers need not hold all images of the face in
  /// memory. Thread-safe.
  /// \param picture  index into face_picture_names
  BlendedPicture blend(const Recipe& recipe, std::size_t picture) const;

  /// Vertex colours of a face; no rows if the heads have no vertex colours. Thread-safe.
  ColourRows vertex_colours(const Recipe& recipe) const;

  /// Mean colour of the skin in a band above the neck's ring, in linear light; nothing if the
  /// config has no `neck` or the heads have no colours. Thread-safe.
  std::optional<Eigen::Array3d> seam_colour(const Recipe& recipe) const;
  /// The painter of the body's texture. Null if the heads are not on a body, if faces have no
  /// colours, or if the config shows no body (`neck.show_body`) and names no texture for it
  /// (`neck.body_texture`).
  const BodyPainter* body_painter() const { return body_.get(); }
  /// The body's texture for a face. Requires body_painter(). Thread-safe.
  BlendedPicture paint_body(const Recipe& recipe) const;

  /// Memory of this object, in bytes.
  std::uint64_t memory_bytes() const;
  /// Memory needed to blend the largest image, in bytes.
  std::uint64_t blend_bytes() const;

 private:
  /// Makes the blenders of all kinds of textures, and computes the data for blending colours.
  void make_blenders(const Config& config);
  /// The weight of each head in the mean colour of the whole face.
  std::vector<double> head_weights_in_mean_colour(const Recipe& recipe) const;

  /// one blender for each kind of blended textures
  std::vector<std::unique_ptr<TextureBlender>> blenders_;
  /// An image that a TextureBlender makes for each face.
  struct Picture {
    const TextureBlender* blender;  ///< the blender that makes the image
    std::size_t index;              ///< index of the image among the blender's images
  };
  std::vector<Picture> pictures_;  ///< all images, in the order of face_picture_names
  const Inputs& inputs_;
  /// whether colours are blended; if not, a face has the colours of its target
  bool are_blended_;
  std::vector<double> region_area_fractions_;  ///< fraction of the face's area in each region
  /// for each vertex, whether it gets the target's colours without blending, as the eyes do
  std::vector<bool> uses_target_colours_only_;
  /// the colours at the neck's ring; nothing if the heads are not on a body or have no colours
  /// there
  std::optional<SeamColours> seam_;
  std::unique_ptr<const BodyPainter> body_;  ///< paints the body's texture; null: see body_painter
};

/// Size, in bytes, of the heads' textures and vertex colours in memory. Texture maps that were
/// moved to files do not count.
std::uint64_t texture_bytes(const Inputs& inputs);

}  // namespace crowdface
