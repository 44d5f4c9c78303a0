// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "head_models/synth/skin_atlas.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {

/// Skin textures of synthetic heads. The albedo shows skin tone, redness, brows, lips, beard, scalp
/// hair, lines and age spots. The normal map contains pores and lines that are too fine for the
/// mesh.
class SyntheticSkins {
 public:
  /// \param size   width and height of the textures in texels, 64 … 8,192.
  /// \param scalp  whether the heads' scalps are bare or haired, see SyntheticHeads::Scalp.
  /// \throws BrokenPrecondition if size is out of range.
  explicit SyntheticSkins(int size, SyntheticHeads::Scalp scalp = SyntheticHeads::Scalp::kHaired);

  /// Returns the width and height of the textures in texels.
  int size() const { return static_cast<int>(atlas_.side()); }
  /// Returns the width and height of the body's texture in texels: half of size(), because crowds
  /// store a tinted copy for each face, and the body has no fine detail.
  int body_size() const { return size() / 2; }
  /// Returns the albedo (sRGB) of head `index` of a seed, for the texture coordinates of
  /// SyntheticHeads: size × size × 3 bytes, row by row, first row at v = 1. The bytes are the same
  /// on every machine.
  std::vector<std::uint8_t> albedo(std::uint64_t seed, std::uint64_t index) const;
  /// Returns the tangent-space normal map in the layout of albedo().
  /// \param edge_cm  SyntheticHeads::edge_cm(); the map contains only relief that is finer than
  ///                 this length.
  std::vector<std::uint8_t> normals(std::uint64_t seed, std::uint64_t index, double edge_cm) const;
  /// Returns the albedo of the body with the skin colour of the youngest of a seed's first five
  /// heads, because the skin of young people is the most even. The albedo is made for the texture
  /// coordinates of SyntheticHeads::body(): body_size() × body_size() × 3 bytes, first row at
  /// v = 1.
  std::vector<std::uint8_t> body_albedo(std::uint64_t seed) const;
  /// Returns the roughness: size × size bytes, first row at v = 1.
  std::vector<std::uint8_t> roughness(std::uint64_t seed, std::uint64_t index) const;

 private:
  synth::SkinAtlas atlas_;
  double scalp_hair_;  ///< parameter `scalp_hair` of SkinPaint
  double texel_cm_;    ///< typical distance on the skin between neighbouring texels, cm
};

}  // namespace crowdface
