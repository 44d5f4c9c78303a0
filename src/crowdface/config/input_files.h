// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"

namespace crowdface {

inline constexpr std::size_t kMinHeads = 2, kMaxHeads = 50;  ///< number of heads of one job

/// Lists the head files directly in the folder, sorted by name: all OBJ files. If there are fewer
/// than two OBJ files, also lists the files of the most frequent other format (is_head_file),
/// except files with the stem of an OBJ file. Skips folders and hidden files, such as the
/// "._head.obj" that some systems create. Includes dangling links, so that they are reported as
/// missing files.
/// \throws MissingInput if the folder cannot be read.
std::vector<std::filesystem::path> list_heads(const std::filesystem::path& folder);

/// Returns a message that names the files in the folder that may contain a mesh but are not in
/// list_heads; empty if there are none. \throws MissingInput if the folder cannot be read.
std::string other_meshes_message(const std::filesystem::path& folder);

/// A hint for a folder without heads whose subfolders contain one mesh each: a pattern for these
/// meshes, up to two folders deep. Empty if no pattern fits.
std::string suggested_head_pattern(const std::filesystem::path& folder);

/// The message for a head whose file gives it a name that is_name refuses.
std::string invalid_head_name_message(const std::string& name, const std::filesystem::path& file);

/// Returns the files that match a pattern such as "people/*/neutral.obj", sorted by path: `*`
/// matches any number of characters except '/', `?` matches one. Wildcards do not match hidden
/// files.
/// \throws MissingInput if a folder cannot be read.
std::vector<std::filesystem::path> files_matching(const std::filesystem::path& pattern);

/// Returns a name for each head: the file's stem. If two stems are equal, uses the parts of the
/// paths that differ instead ("people/ann/neutral.obj": "ann").
std::vector<std::string> names_of_heads(const std::vector<std::filesystem::path>& files);

/// Lists every file that the config names: the config itself, heads, shapes, points, rig,
/// neck, attachments, masks with all their tiles, reviews, edits, and the mesh for comparisons.
/// Material files and textures are not listed, because the head files name them.
std::vector<std::filesystem::path> input_files(const Config& config);

/// \throws UsageError if a path is not UTF-8 or contains a control character, because a config
/// cannot store such a path.
void require_storable_path(const std::filesystem::path& path);

/// Adds a problem for each path that a config cannot store (see require_storable_path),
/// among the absolute paths of the input files and the crowd's folder. The crowd's config.yaml
/// stores these paths.
void check_paths(const Config& config, Problems& problems);

}  // namespace crowdface
