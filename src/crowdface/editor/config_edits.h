// SPDX-License-Identifier: Apache-2.0
// Edits of a config: the changes of config sections that the editor makes. The editor saves the
// edits in a separate file, which the config's key `edits` names. If the config has no such key,
// the editor adds the key to the config, with the file `NAME_edits.yaml` in the same folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/config.h"

namespace crowdface {

/// Saves a recipe in the edits. Replaces a recipe with the same id.
/// \return the file of the edits.
/// \throws Error with every problem that the new config would have; in this case no file changes.
std::filesystem::path save_recipe_in_edits(const ManualRecipe& recipe, const Config& config);

/// Saves regions in the edits. These regions replace all regions of the config.
/// \param config  file of the config.
/// \return the file of the edits.
/// \throws Error as save_recipe_in_edits does, for example if another part of the config names a
///         region that the new regions lack.
std::filesystem::path save_regions_in_edits(const std::filesystem::path& config,
                                            const std::vector<std::string>& names,
                                            const std::vector<std::filesystem::path>& masks);

/// Adds new heads to the list `faces.also` in the file of edits.
/// \param config  file of the config.
/// \param heads   mesh files of the new heads.
/// \return the file of the edits.
/// \throws Error as save_recipe_in_edits does, for example if two heads would have the same name.
std::filesystem::path save_heads_in_edits(const std::filesystem::path& config,
                                          const std::vector<std::filesystem::path>& heads);

/// The value of a section in a file of edits, as YAML on one line; nothing if the file has no such
/// section.
/// \param edits  the file of edits; may be empty or not exist
std::optional<std::string> section_in_edits(const std::filesystem::path& edits,
                                            const std::string& section);

/// Restores a section of the edits to a value that section_in_edits returned earlier. Removes the
/// section if this value is empty.
/// \return the file of the edits.
/// \throws Error as save_recipe_in_edits does, or if the text `value` contains more than one YAML
///     value.
std::filesystem::path restore_section(const std::filesystem::path& config,
                                      const std::string& section,
                                      const std::optional<std::string>& value);

}  // namespace crowdface
