// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "crowdface/core/problems.h"
#include "crowdface/job/config.h"

namespace crowdface {

/// Every file that a job reads: its config, heads, masks with all their tiles, reviews, and a mesh
/// that faces are compared with. (Material files and textures are found through the heads.)
std::vector<std::filesystem::path> input_files(const Config& config);

/// \throws UsageError if `path` is one of them, under whatever name.
void refuse_to_write_over_inputs(const Config& config, const std::filesystem::path& path);

/// \throws UsageError if a path is not UTF-8 or holds a control character: no config can name it.
void refuse_path_no_config_can_hold(const std::filesystem::path& path);

/// Adds each such path among the absolute ones of all inputs and of the crowd's folder: the crowd's
/// own config names them.
void check_paths(const Config& config, Problems& problems);

}  // namespace crowdface
