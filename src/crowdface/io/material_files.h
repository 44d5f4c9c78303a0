// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crowdface {

/// One file to put beside a mesh so that its `mtllib` and the textures named there are found.
struct MaterialFile {
  std::filesystem::path from;      ///< where it is
  std::filesystem::path relative;  ///< where it goes, below the meshes' folder
};

struct MaterialFiles {
  std::vector<MaterialFile> files;    ///< each destination once
  std::vector<std::string> warnings;  ///< about files that are missing or lie outside the folder
};

/// The material files that a mesh names and the textures that those name. A file that is missing is
/// a warning, not an error; so is a path that leads out of the mesh's folder, which is not followed.
/// \param mesh       path of the OBJ file.
/// \param libraries  the arguments of its `mtllib` lines; each may name several files.
MaterialFiles find_material_files(const std::filesystem::path& mesh,
                                  const std::vector<std::string>& libraries);

}  // namespace crowdface
