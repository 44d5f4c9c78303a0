// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface::synth {

/// A style of brows or beard.
struct FacialHair {
  std::string_view name;
  bool is_beard = false;
  bool is_for_women = false;
  double relative_frequency = 1;  ///< how often people have this style, relative to other styles
  double brow_width = 1;          ///< for brows: factor on the thickness of the brows
  double brow_arch = 0;           ///< for brows: additional height of the brows' arch, cm
  double brow_density = 0.9;      ///< for brows: factor on the density of the hairs
  /// for beards: length of the hair on cheeks and jaw, on the upper lip and on the chin; on the
  /// scale of Complexion::beard, where 1 is a short beard
  double cheek_beard = 0, lip_beard = 0, chin_beard = 0;
};
/// Returns all styles of brows and beards.
std::span<const FacialHair> facial_hairs();

/// Brows or a beard as a mesh close above the skin of the average head, with its neutral texture.
struct FacialHairLayer {
  Mesh mesh;
  int width = 0, height = 0;         ///< size of the texture, in texels
  std::vector<std::uint8_t> pixels;  ///< sRGB and alpha, row by row, first row at v = 1
};
/// Makes the layer of a style. \param skin  the skin of the average head, cm.
FacialHairLayer facial_hair_layer(const FacialHair& style, const Mesh& skin);

}  // namespace crowdface::synth
