// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace crowdface {

/// The appearance of a material in a USD layer. Files are relative to the layer; an empty name
/// means no file.
struct UsdaSurface {
  std::array<float, 4> colour = {
      1, 1, 1, 1};             ///< linear RGB if there is no picture; opacity if there is no mask
  std::string picture = {};    ///< colour map, sRGB
  std::string normals = {};    ///< tangent-space normal map
  std::string roughness = {};  ///< roughness map, first channel
  /// Mask file: the surface is opaque where the mask is at least one half.
  std::string holes = {};
  /// The mask is the file's alpha channel, or else its first channel.
  bool holes_in_alpha = false;
  bool overlay = false;  ///< the primvar is `st1`, clamped; otherwise `st`, repeated
};

/// A Scope prim below the root that contains Material prims with preview surfaces; empty without
/// materials.
/// \param scope  name of the Scope prim.
/// \param names  of the Material prims; materials with an empty name are left out.
/// \param surfaces  #names
std::string usda_materials(const std::string& root, const std::string& scope,
                           const std::vector<std::string>& names,
                           const std::vector<UsdaSurface>& surfaces);

}  // namespace crowdface
