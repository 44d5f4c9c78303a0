// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "crowdface/io/file_mesh.h"

namespace crowdface {

/// The endings of the files that read_mesh takes, ".obj" first, in lower case.
const std::vector<std::string_view>& mesh_endings();

/// Reads a mesh. (An array of NumPy may come without faces.) The format is told by how the file begins, or else by its name's ending.
/// \throws MissingInput; InvalidInput naming the file, what was expected, what was found and what helps.
FileMesh read_mesh(const std::filesystem::path& path);

}  // namespace crowdface
