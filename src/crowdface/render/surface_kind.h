// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// What a face of the mesh is made of, as far as a render without textures needs to know.
enum class SurfaceKind : std::uint8_t {
  kSkin,
  kEye,  ///< the white of the eye
  kIris,
  kTeeth,
  kGums,    ///< and tongue
  kWorn,    ///< beside a head: hair, glasses; it has colours of its own
  kHidden,  ///< not drawn: lashes, tear fluid and shells that need textures to be seen through
};

/// What each face of a mesh is made of.
struct Surfaces {
  std::vector<SurfaceKind> kinds;  ///< #F, or empty: all skin
  /// #F colours (sRGB) in place of those of the kinds, or empty: none has any.
  std::vector<std::optional<Eigen::Array3f>> paints = {};
  /// #T by 2 texture coordinates of the topology's corners, or empty: no textures.
  TextureCoordinates uvs = {};
};

/// The kind that a material's (or group's) name speaks of, in any case and anywhere in the name:
/// "M_ScleraLeft" is an eye, "M_EyeLashes" is hidden. Skin if nothing is recognised.
SurfaceKind surface_kind_of_material(std::string_view material_name);

}  // namespace crowdface
