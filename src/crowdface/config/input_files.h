// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"

namespace crowdface {

inline constexpr std::size_t kFewestHeads = 2, kMostHeads = 50;  ///< of one job

/// Every OBJ file directly in the folder, by name. Hidden files (such as the "._head.obj" that some
/// systems leave behind) and folders do not count; a link that leads nowhere does, as a file that
/// is missing. \throws MissingInput if the folder cannot be read.
std::vector<std::filesystem::path> list_heads(const std::filesystem::path& folder);

/// Every file that a job reads: its config, heads, masks with all their tiles, reviews, and a mesh
/// that faces are compared with. (Material files and textures are found through the heads.)
std::vector<std::filesystem::path> input_files(const Config& config);

/// \throws UsageError if a path is not UTF-8 or holds a control character: no config can name it.
void refuse_path_no_config_can_hold(const std::filesystem::path& path);

/// Adds each such path among the absolute ones of all inputs and of the crowd's folder: the crowd's
/// own config names them.
void check_paths(const Config& config, Problems& problems);

}  // namespace crowdface
