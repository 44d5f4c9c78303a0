// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

namespace crowdface {

/// The colour of an additional mesh in the file of one face.
struct PartLook {
  std::array<float, 3> tint = {1, 1, 1};  ///< factors on the light of the materials, linear RGB
  /// Folder of the textures in this colour, inside the folder of the mesh's other material files;
  /// empty: the textures are used as they are.
  std::string folder = {};
};

}  // namespace crowdface
