// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace crowdface {

/// The appearance of a material in a USD layer. Paths of files are relative to the layer; an empty
/// path means that there is no file.
struct UsdaSurface {
  /// linear RGB, used if there is no colour map; and opacity, used if there is no mask
  std::array<float, 4> colour = {1, 1, 1, 1};
  std::string colour_map = {};     ///< path of the colour map, sRGB
  std::string normal_map = {};     ///< path of the tangent-space normal map
  std::string roughness_map = {};  ///< path of the roughness map; its first channel is used
  /// Path of a mask file. The surface is opaque where the mask is at least one half; elsewhere it
  /// has holes.
  std::string opacity_map = {};
  /// Whether the alpha channel of the mask file is the mask; otherwise the first channel is the
  /// mask.
  bool is_opacity_in_alpha = false;
  /// Whether the colour map is an overlay (see GlbOverlay), which has its own texture coordinates.
  /// If so, textures use the primvar `st1` and are clamped; otherwise, they use `st` and repeat.
  bool is_overlay = false;
};

/// The text of a Scope prim, which is below the root prim and contains Material prims with preview
/// surfaces. Empty if there are no materials.
/// \param root   path of the root prim.
/// \param scope  name of the Scope prim.
/// \param names  names of the Material prims; materials with an empty name are skipped.
/// \param surfaces  one per name
std::string usda_materials(const std::string& root, const std::string& scope,
                           const std::vector<std::string>& names,
                           const std::vector<UsdaSurface>& surfaces);

}  // namespace crowdface
