// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/io/file_mesh.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// Whether a head may be stored in a file with this extension. The format must keep the vertex
/// order, or must allow split vertices to be joined again. STL does neither.
bool is_head_file(const std::filesystem::path& path);
/// Whether the extension is ".obj", ignoring case.
bool is_obj(const std::filesystem::path& path);

/// Converts a mesh to an OBJ file in memory.
/// \param path  path of the file from which the mesh was read.
/// \param library  material file to name in the OBJ text; may be empty.
/// \throws InvalidInput if the mesh has no polygons or positions are not finite.
ObjFile convert_to_obj(FileMesh mesh, const std::filesystem::path& path,
                       const std::string& library = {});

/// Reads a mesh of any format and joins vertices that the format split (see `join_split_vertices`).
FileMesh read_joined_mesh(const std::filesystem::path& path);
/// Reads a mesh of any format and returns it as an OBJ file. An OBJ file keeps its text; other
/// formats get a new text. Reverses the polygons of a mesh that is inside out.
ObjFile read_mesh_as_obj(const std::filesystem::path& path);

}  // namespace crowdface
