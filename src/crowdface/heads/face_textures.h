// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface {

/// The textures of faces.
class FaceTextures {
 public:
  /// \param inputs  must outlive this object.
  FaceTextures(const Config& config, const Inputs& inputs);
  /// What blends them; null if faces get none of their own.
  const TextureBlender* blender() const { return blender_.get(); }

 private:
  std::unique_ptr<TextureBlender> blender_;
};

/// What the heads' maps take that lie in memory.
std::uint64_t texture_bytes(const HeadTextures& textures);

}  // namespace crowdface
