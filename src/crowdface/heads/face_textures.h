// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface {

/// The pictures that each face has of its own: those of its colours, then those of each other kind.
std::vector<PictureName> own_pictures(const Inputs& inputs);

inline bool has_own_textures(const Inputs& inputs) {
  return inputs.textures.blend() || !inputs.maps.empty();
}

class FaceTextures {
 public:
  /// \param inputs  must outlive this object.
  FaceTextures(const Config& config, const Inputs& inputs);
  bool any() const { return !pictures_.empty(); }
  /// Of own_pictures.
  std::size_t picture_count() const { return pictures_.size(); }
  /// \param picture  as own_pictures has them: no more than one need be in memory. Any thread may ask.
  BlendedPicture blend(const Recipe& recipe, std::size_t picture) const;

  /// A face's colours at vertices; no rows where the heads have none. Any thread may ask.
  ColourRows vertex_colours(const Recipe& recipe) const;

  /// What this object itself takes, and what the blending of the largest picture takes.
  std::uint64_t memory_bytes() const;
  std::uint64_t blend_bytes() const;

 private:
  std::vector<std::unique_ptr<TextureBlender>> blenders_;
  struct Picture {
    const TextureBlender* blender;
    std::size_t number;  ///< of the blender's
  };
  std::vector<Picture> pictures_;
  const Inputs& inputs_;
  bool are_blended_;                   ///< or the target's own
  std::vector<double> region_shares_;  ///< of the face
  std::vector<bool> of_target_;        ///< #V, see blend_vertex_colours
};

/// What the heads' maps take that lie in memory.
std::uint64_t texture_bytes(const Inputs& inputs);

}  // namespace crowdface
