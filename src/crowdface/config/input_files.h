// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"

namespace crowdface {

inline constexpr std::size_t kFewestHeads = 2, kMostHeads = 50;  ///< of one job

/// The heads directly in the folder, by name: its OBJ files; where it has fewer than two of them, also the files of the
/// kind (is_head_file) that most are of. Hidden files (such as the "._head.obj" that some systems leave behind) and
/// folders do not count; a link that leads nowhere does, as a file that is missing.
/// \throws MissingInput if the folder cannot be read.
std::vector<std::filesystem::path> list_heads(const std::filesystem::path& folder);

/// A sentence for all files of the folder that hold meshes, and that list_heads leaves out; empty if there are none.
std::string left_out_of_heads(const std::filesystem::path& folder);

/// The files that a pattern such as "people/*/neutral.obj" names, by name: `*` stands for any letters but '/', `?` for
/// one. \throws MissingInput if a folder cannot be read.
std::vector<std::filesystem::path> files_like(const std::filesystem::path& pattern);

/// A name for each head: its file's without ending or, where these are not all different, the parts of the paths that
/// differ ("people/ann/neutral.obj": "ann").
std::vector<std::string> names_of_heads(const std::vector<std::filesystem::path>& files);

/// Every file that a job reads: its config, heads, masks with all their tiles, reviews, and a mesh
/// that faces are compared with. (Material files and textures are found through the heads.)
std::vector<std::filesystem::path> input_files(const Config& config);

/// \throws UsageError if a path is not UTF-8 or holds a control character: no config can name it.
void refuse_path_no_config_can_hold(const std::filesystem::path& path);

/// Adds each such path among the absolute ones of all inputs and of the crowd's folder: the crowd's
/// own config names them.
void check_paths(const Config& config, Problems& problems);

}  // namespace crowdface
