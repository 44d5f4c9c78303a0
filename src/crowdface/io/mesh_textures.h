// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/io/file_mesh.h"

namespace crowdface {

/// Writes the textures of a mesh as image files to a folder, and a material file that names them.
/// \param name  prefix of the file names.
/// \return the name of the material file.
/// \throws CannotCreate, IoError
std::string write_mesh_textures(const FileMesh& mesh, const std::filesystem::path& folder,
                                const std::string& name);

/// A material name that is valid in OBJ and material files: one line, not empty.
std::string material_name_of(std::string name);

}  // namespace crowdface
