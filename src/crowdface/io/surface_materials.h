// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/io/material_files.h"

namespace crowdface {

/// The colour, opacity and maps of a material, as its material file describes them.
struct SurfaceMaterial {
  std::string name;
  std::optional<std::array<float, 3>> colour = {};  ///< `Kd`, linear, from 0 to 1
  float opacity = 1;                                ///< `d`, or 1 − `Tr`
  std::filesystem::path colour_map = {};            ///< the file of `map_Kd`; empty: there is none
  std::filesystem::path opacity_map = {};           ///< the file of `map_d`; empty: there is none
};

/// The materials of a mesh, in the order of its material files. Ignores textures that are not in
/// `files`.
/// \param files  result of `find_material_files`.
std::vector<SurfaceMaterial> read_surface_materials(const MaterialFiles& files);

/// Returns the first material in the files with each of these names, or a default material if there
/// is none.
std::vector<SurfaceMaterial> surface_materials_of(const std::vector<std::string>& names,
                                                  const MaterialFiles& files);

}  // namespace crowdface
