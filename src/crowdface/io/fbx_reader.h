// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/file_mesh.h"

namespace crowdface {

/// Signature of the FBX parser in the shared library that contains Assimp (assimp_reader.cpp). The
/// program loads the library when it reads the first FBX file. The signature uses only types of
/// this project.
/// \return whether the file could be read; if not, `error` gives the reason.
/// \param external_textures  one entry per texture: the path of the texture file, as the exporting
///                           machine wrote it; empty for an embedded texture
using ReadFbx = bool(std::string_view bytes, FileMesh& mesh,
                     std::vector<std::string>& external_textures, std::string& error);

/// Reads all meshes of an FBX file and applies the transforms of their nodes. Does not triangulate
/// polygons. Assimp creates one vertex per polygon corner, so the original vertex order is lost.
/// `join_split_vertices` merges the copies of a vertex.
/// \param path  path of the FBX file; the function searches for external textures beside this file.
/// \throws InvalidInput; IoError if the library cannot be loaded.
FileMesh parse_fbx(std::string_view bytes, const std::filesystem::path& path);

}  // namespace crowdface
