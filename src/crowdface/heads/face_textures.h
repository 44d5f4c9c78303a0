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
  bool any() const { return !blenders_.empty(); }
  /// What blends the colours; null if faces get none of their own.
  const TextureBlender* colours() const;
  /// Pictures as own_pictures has them. Any thread may ask.
  std::vector<BlendedPicture> blend(const Recipe& recipe) const;

  /// What this object itself takes, and what the blending of one face takes.
  std::uint64_t memory_bytes() const;
  std::uint64_t blend_bytes() const;

 private:
  bool has_colours_;
  std::vector<std::unique_ptr<TextureBlender>> blenders_;
};

/// What the heads' maps take that lie in memory.
std::uint64_t texture_bytes(const Inputs& inputs);

}  // namespace crowdface
