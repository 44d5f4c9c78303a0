// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/io/file_mesh.h"

namespace crowdface {

/// Writes the textures of a mesh as image files into a folder, and beside them a material file that names them.
/// \param name  how the files' names begin
/// \return the name of the material file. \throws CannotCreate, IoError
std::string write_mesh_textures(const FileMesh& mesh, const std::filesystem::path& folder,
                                const std::string& name);

/// A material's name as OBJ and material files have it: on one line, not empty.
std::string material_name_of(std::string name);

}  // namespace crowdface
