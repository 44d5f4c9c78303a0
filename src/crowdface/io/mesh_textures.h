// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/io/file_mesh.h"

namespace crowdface {

/// Writes the textures of a mesh as image files to a folder, and a material file that names them.
/// \param name  prefix of the file names.
/// \return the name of the material file.
/// \throws CannotCreate, IoError
std::string write_mesh_textures(const FileMesh& mesh, const std::filesystem::path& folder,
                                const std::string& name);

/// Reads the bytes of textures that are separate files. A file is searched at its name
/// relative to the mesh file, then by `search_texture`. Removes textures without a file and adds a
/// note for each.
/// \param files  #mesh.textures: the names of the files; an empty name if the texture has its bytes
/// \param path   of the mesh file
void read_texture_files(std::vector<std::string> files, const std::filesystem::path& path,
                        FileMesh& mesh);

/// A material name that is valid in OBJ and material files: one line, not empty.
std::string material_name_of(std::string name);

}  // namespace crowdface
