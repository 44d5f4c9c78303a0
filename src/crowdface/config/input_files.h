// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"

namespace crowdface {

/// smallest and largest number of heads in a config
inline constexpr std::size_t kMinHeads = 2, kMaxHeads = 50;

/// Lists the files in a folder that are heads, sorted by name: all OBJ files. If there are fewer
/// than two OBJ files, and another format (see is_head_file) is more frequent, also lists the files
/// of the most frequent format, except files that have the same stem as an OBJ file. Ignores
/// subfolders, NumPy arrays that are not the points of one head, and hidden files, such as the
/// "._head.obj" that some systems create. Includes symbolic links to missing files, so that these
/// are reported as missing.
///
/// \throws MissingInput if the folder cannot be read.
std::vector<std::filesystem::path> list_heads(const std::filesystem::path& folder);

/// Returns a message about the files in the folder that may contain a mesh but are not listed by
/// list_heads; an empty text if there are no such files.
///
/// \throws MissingInput if the folder cannot be read.
std::string left_out_meshes_message(const std::filesystem::path& folder);

/// Returns a hint for a folder that contains no heads itself, but has one subfolder for each head:
/// a text that suggests a pattern for `faces.files`, such as "people/*/neutral.obj". Searches up to
/// two folders deep. Empty if no such pattern matches at least kMinHeads files.
std::string suggested_head_pattern(const std::filesystem::path& folder);

/// Returns advice for a message about a path that does not exist: the path has backslashes, or the
/// folder has an entry whose name differs only in case or in Unicode's normal form. Returns an
/// empty text in all other cases.
std::string advice_on_path(const std::filesystem::path& path);

/// Returns why a head cannot have this name: the name is invalid (see is_valid_name), reserved, or
/// one of the names of other heads. Empty if the head can have the name.
std::string objection_to_head_name(const std::string& name, const std::filesystem::path& file,
                                   const std::vector<std::string>& other_names);

/// Returns the files that match a pattern such as "people/*/neutral.obj", sorted by path. `*`
/// matches any number of characters except '/', and `?` matches one character. Wildcards do not
/// match hidden files.
///
/// \throws MissingInput if a folder cannot be read.
std::vector<std::filesystem::path> files_matching(const std::filesystem::path& pattern);

/// Returns the files that match a pattern and may be heads.
/// \param left_out  receives a message about the matching files that may contain a mesh but cannot
///                  be heads; empty if there are no such files.
std::vector<std::filesystem::path> heads_matching(const std::filesystem::path& pattern,
                                                  std::string& left_out);

/// Returns a name that a head can have: removes the accents of `stem`, and replaces the other
/// characters that the name of a head cannot have (see objection_to_head_name) by `_`.
std::string valid_head_name(const std::string& stem);

/// Returns the name of each head: the stem of the file's name, as a valid name. If two stems are
/// equal, the names consist of the parts in which the paths differ. The name of
/// "people/ann/neutral.obj" is then "ann".
std::vector<std::string> names_of_heads(const std::vector<std::filesystem::path>& files);

/// Returns the config file and every file that the config names, with all tiles of the masks. Does
/// not return the heads' materials and textures, because only the heads' files name these files.
std::vector<std::filesystem::path> input_files(const Config& config);

/// Checks that a config can store a path.
///
/// \throws UsageError if the path is not UTF-8 or contains a control character.
void require_storable_path(const std::filesystem::path& path);

/// Checks the absolute paths of all input files and of the crowd's folder. Adds a problem for each
/// path that the crowd's config.yaml cannot store; see require_storable_path.
void check_paths(const Config& config, Problems& problems);

}  // namespace crowdface
