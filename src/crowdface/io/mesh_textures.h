// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/file_mesh.h"

namespace crowdface {

/// Writes the textures of a mesh as image files to a folder, and a material file that names these
/// image files.
/// \param name  prefix of the file names.
/// \return the name of the material file.
/// \throws CannotCreate, IoError
std::string write_mesh_textures(const FileMesh& mesh, const std::filesystem::path& folder,
                                const std::string& name);

/// Reads the bytes of textures that are separate files. Looks for each file first at its path
/// relative to the mesh file, then with `search_texture`. If a file is not found, removes the
/// texture and adds a note.
/// \param files  for each texture of the mesh, the name of its file; an empty name if the mesh file
///               embeds the texture
/// \param path   path of the mesh file
void read_texture_files(std::vector<std::string> files, const std::filesystem::path& path,
                        FileMesh& mesh);

/// Finds the material file or the texture that probably belongs to an OBJ file that names no
/// material file. This is the material file that differs from the OBJ file only in its extension,
/// or, if there is none, the image that differs only in its extension.
/// \param path  path of the OBJ file.
/// \param text  content of the OBJ file.
/// \return an empty path if there is no such file, if the OBJ file names a material file, or if the
///         OBJ file has no texture coordinates.
std::filesystem::path find_unnamed_texture(const std::filesystem::path& path,
                                           std::string_view text);

bool is_material_file(const std::filesystem::path& path);

/// Returns one colour texture for each of the materials. The content of each texture is the image.
/// If there are no materials, returns one texture for a material without a name.
std::vector<MeshTexture> colour_textures(const std::filesystem::path& image,
                                         const std::vector<MaterialRange>& materials);

/// Changes a text into a name that is valid for a material in OBJ and material files: one line, not
/// empty.
std::string material_name_of(std::string name);

}  // namespace crowdface
