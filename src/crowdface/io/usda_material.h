// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace crowdface {

/// How a surface looks, as a USD layer says it. Files are named relative to the layer; empty: there is none.
struct UsdaSurface {
  std::array<float, 4> colour = {
      1, 1, 1, 1};              ///< linear red green blue without a picture; opacity without holes
  std::string picture = {};     ///< its colours, sRGB
  std::string normals = {};     ///< in tangent space
  std::string roughness = {};   ///< in the first channel
  std::string holes = {};       ///< where the surface is: one half and more of …
  bool holes_in_alpha = false;  ///< … the file's alpha, or else its first channel
  bool overlay = false;  ///< laid out by the primvar `st1`, and nothing around it; else by `st`
};

/// A Scope prim below the root, of Material prims with preview surfaces; none without materials.
/// \param scope     the prim's name.
/// \param names     of the materials; those of no name are left out.
/// \param surfaces  #names
std::string usda_materials(const std::string& root, const std::string& scope,
                           const std::vector<std::string>& names,
                           const std::vector<UsdaSurface>& surfaces);

}  // namespace crowdface
