// SPDX-License-Identifier: Apache-2.0
// Edits of a config: the changes that the editor saves, in the file that the config's key `edits`
// names. If the config has no such key, the editor adds it to the config, with the file
// `NAME_edits.yaml` in the same folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/config.h"

namespace crowdface {

/// Saves a recipe, in place of a recipe with the same id.
/// \return the file of the edits.
/// \throws Error with every problem that the new config would have; in this case no file changes.
std::filesystem::path put_recipe(const ManualRecipe& recipe, const Config& config);

/// Saves regions, in place of the config's regions.
/// \param config  file of the config.
/// \return the file of the edits.
/// \throws Error as put_recipe does, for example if another part of the config names a region that
///         the new regions lack.
std::filesystem::path put_regions(const std::filesystem::path& config,
                                  const std::vector<std::string>& names,
                                  const std::vector<std::filesystem::path>& masks);

/// Adds heads after the config's heads, and saves the edits.
/// \param config  file of the config.
/// \param heads   files of meshes.
/// \return the file of the edits.
/// \throws Error as put_recipe does, for example if two heads would have the same name.
std::filesystem::path put_heads(const std::filesystem::path& config,
                                const std::vector<std::filesystem::path>& heads);

/// The value of a section in a file of edits, on one line; nothing if the file has none.
/// \param edits  the file; empty or absent: nothing
std::optional<std::string> section_in_edits(const std::filesystem::path& edits,
                                            const std::string& section);

/// Restores a value that section_in_edits returned.
/// \return the file of the edits.
/// \throws Error as put_recipe does, or if `value` is more than one value.
std::filesystem::path restore_section(const std::filesystem::path& config,
                                      const std::string& section,
                                      const std::optional<std::string>& value);

}  // namespace crowdface
