// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/io/file_mesh.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// Whether a head may lie in such a file, by its name's ending: a format that keeps the order of vertices, or in which
/// they can be joined again. STL keeps none.
bool is_head_file(const std::filesystem::path& path);
bool is_obj(const std::filesystem::path& path);

/// A mesh as the OBJ file that would be written of it: its text is in memory.
/// \param path     of the file that it comes from. \param library  the material file that it names; may be empty
/// \throws InvalidInput if it has no faces, or positions are not finite.
ObjFile as_obj(FileMesh mesh, const std::filesystem::path& path, const std::string& library = {});

/// A mesh of any format; vertices that a format split are joined, and it is said.
FileMesh read_joined_mesh(const std::filesystem::path& path);
/// The same as an OBJ file, one that is OBJ as it is; a mesh that is inside out is turned.
ObjFile read_mesh_as_obj(const std::filesystem::path& path);

}  // namespace crowdface
