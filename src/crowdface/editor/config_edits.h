// SPDX-License-Identifier: Apache-2.0
// What the editor saves for a config: in the file that the config names as `edits`. A config that names
// none gets one line more, which names `NAME_edits.yaml` beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/config/config.h"

namespace crowdface {

/// Saves a recipe, in place of one with the same id. \return the file of the edits.
/// \throws Error with every problem that the config would have; all files stay as they are then.
std::filesystem::path put_recipe(const HandRecipe& recipe, const Config& config);

/// Saves regions, in place of those of the config. \param config  its file. \return the file of the edits.
/// \throws Error as above: other parts of the config may name a region that is gone.
std::filesystem::path put_regions(const std::filesystem::path& config,
                                  const std::vector<std::string>& names,
                                  const std::vector<std::filesystem::path>& masks);

}  // namespace crowdface
