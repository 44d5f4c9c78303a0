// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/io/material_files.h"

namespace crowdface {

/// What a material file says of how a surface looks.
struct SurfaceMaterial {
  std::string name;
  std::optional<std::array<float, 3>> colour = {};  ///< `Kd`, linear
  float opacity = 1;                                ///< `d`, or one less `Tr`
  std::filesystem::path colour_map = {};            ///< the file of `map_Kd`; empty: there is none
  std::filesystem::path opacity_map = {};           ///< of `map_d`
};

/// The materials of a mesh, in the order of its files. Of textures only those among the files count.
/// \param files  as find_material_files gives them.
std::vector<SurfaceMaterial> read_surface_materials(const MaterialFiles& files);

/// Of each of these names the first such material; one that no file describes has but its name.
std::vector<SurfaceMaterial> surface_materials_of(const std::vector<std::string>& names,
                                                  const MaterialFiles& files);

}  // namespace crowdface
