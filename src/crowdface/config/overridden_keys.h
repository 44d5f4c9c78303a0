// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/config/yaml_node.h"

namespace crowdface {

/// Returns one line of text for each key that another key overrides, among the keys that restrict
/// faces to heads, tags or shares. Each line names both keys and the number of faces concerned.
///
/// \param root    the config file, with all command-line overrides and edits.
/// \param config  the complete config that was read from `root`.
std::vector<std::string> overridden_keys(const YamlNode& root, const Config& config);

}  // namespace crowdface
