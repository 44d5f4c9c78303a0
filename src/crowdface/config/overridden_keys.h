// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/config/yaml_node.h"

namespace crowdface {

/// Finds keys of `sampling`, `groups`, `families`, `recipes` and `attachments` that another key
/// overrides. Returns one warning (a line of text) for each overridden key. The warning names both
/// keys and the number of affected faces.
///
/// \param root    the config file, with all command-line overrides and edits.
/// \param config  the complete config that was read from `root`.
std::vector<std::string> overridden_key_warnings(const YamlNode& root, const Config& config);

}  // namespace crowdface
