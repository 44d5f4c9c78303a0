// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "crowdface/io/file_mesh.h"

namespace crowdface {

/// The file extensions that `read_mesh` accepts, in lower case, ".obj" first.
const std::vector<std::string_view>& mesh_extensions();

/// Reads a mesh. The first bytes of the file determine the format; if they match no known format,
/// the file's extension determines it. A mesh from a NumPy file may lack polygons.
/// \throws MissingInput; InvalidInput, whose message names the file, what was expected, what was
/// found, and a remedy.
FileMesh read_mesh(const std::filesystem::path& path);

}  // namespace crowdface
