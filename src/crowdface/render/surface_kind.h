// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace crowdface {

/// What a face of the mesh is made of, as far as a render without textures needs to know.
enum class SurfaceKind : std::uint8_t {
  kSkin,
  kEye,  ///< the white of the eye
  kIris,
  kTeeth,
  kGums,    ///< and tongue
  kHidden,  ///< not drawn: lashes, tear fluid and shells that need textures to be seen through
};

/// The kind that a material's (or group's) name speaks of, in any case and anywhere in the name:
/// "M_ScleraLeft" is an eye, "M_EyeLashes" is hidden. Skin if nothing is recognised.
SurfaceKind surface_kind_of_material(std::string_view material_name);

}  // namespace crowdface
