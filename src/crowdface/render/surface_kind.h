// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Material of a polygon of the mesh, for renders without textures.
enum class SurfaceKind : std::uint8_t {
  kSkin,
  kEye,  ///< white of the eye
  kIris,
  kTeeth,
  kGums,        ///< gums and tongue
  kAttachment,  ///< attachment with colours of its own: hair, glasses
  /// Not rendered: lashes, tear fluid, and transparent shells such as the cornea, which would look
  /// opaque without a texture.
  kHidden,
};

/// Materials and colours of the polygons of a mesh.
struct Surfaces {
  std::vector<SurfaceKind> kinds;  ///< one per polygon; if empty, all polygons are skin
  /// For each polygon, an sRGB colour that replaces the default colour of the polygon's kind; or
  /// empty.
  std::vector<std::optional<Eigen::Array3f>> polygon_colours = {};
  /// #T by 2 texture coordinates, indexed by the topology's corners; or empty: no textures.
  TextureCoordinates uvs = {};
};

/// The surface kind that a material or group name suggests. Searches for known words anywhere in
/// the name, ignoring case: "M_ScleraLeft" is an eye, "M_EyeLashes" is hidden. Skin if no word is
/// found.
SurfaceKind surface_kind_of_material(std::string_view material_name);

}  // namespace crowdface
