// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "head_models/synth/skin_atlas.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {

/// Textures of synthetic heads' skin, painted from who each of them is. Colours: tone, redness, brows, lips,
/// stubble, cropped hair, lines and spots of age. Normals: pores and lines that the mesh is too coarse for.
class SyntheticSkins {
 public:
  /// \param size  side of the pictures in texels, 64 … 8,192. \throws BrokenPrecondition
  /// \param scalp  that of the heads
  explicit SyntheticSkins(int size, SyntheticHeads::Scalp scalp = SyntheticHeads::Scalp::kHaired);

  int size() const { return size_; }
  /// The colours (sRGB) of head `index` of a seed, for the texture coordinates of SyntheticHeads: size ×
  /// size × 3 bytes, row by row, first row at v = 1. The same bytes on every machine.
  std::vector<std::uint8_t> albedo(std::uint64_t seed, std::uint64_t index) const;
  /// Tangent-space normals of the relief that meshes of SyntheticHeads with such edges do not have, likewise.
  std::vector<std::uint8_t> normals(std::uint64_t seed, std::uint64_t index, double edge_cm) const;
  /// Roughness, size × size bytes.
  std::vector<std::uint8_t> roughness(std::uint64_t seed, std::uint64_t index) const;

 private:
  int size_;
  double scalp_hair_;  ///< see SkinPaint
  std::vector<synth::SkinPlace> atlas_;
  double texel_cm_ = 0;
};

}  // namespace crowdface
