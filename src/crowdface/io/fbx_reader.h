// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/file_mesh.h"

namespace crowdface {

/// Reads FBX files. A function, and no types but ours: Assimp stands in a shared library (assimp_reader.cpp), which is
/// opened when a file of this kind is met.
/// \param beside  #textures: the file of each that lies beside, as another machine may have named it; else empty
using ReadFbx = bool(std::string_view bytes, FileMesh& mesh, std::vector<std::string>& beside,
                     std::string& error);

/// All meshes where their nodes stand, with polygons as they are. Assimp gives each corner a vertex of its own: their
/// order is lost, and join_split_vertices joins them.
/// \param path  beside which textures lie. \throws InvalidInput; IoError if the library cannot be loaded.
FileMesh parse_fbx(std::string_view bytes, const std::filesystem::path& path);

}  // namespace crowdface
