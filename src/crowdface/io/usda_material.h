// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

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

/// A Material prim with a preview surface. \param path  of the prim. \param name  its last part.
std::string usda_material(const std::string& path, const std::string& name,
                          const UsdaSurface& surface);

}  // namespace crowdface
