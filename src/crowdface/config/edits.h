// SPDX-License-Identifier: Apache-2.0
// The file of the config key `edits`: recipes and regions that `crowdface edit` saved.
#pragma once

#include "crowdface/config/config_draft.h"
#include "crowdface/config/yaml.h"

namespace crowdface {

/// Replaces each section of `root` by the one in `edits`, except `recipes`: each edited recipe
/// replaces the recipe with the same id, or is appended.
void merge_edits(const YamlNode& edits, YamlNode& root);

/// Merges the file of the key `edits` into `root`, if the config has that key.
void read_edits(YamlNode& root, ConfigDraft& draft);

}  // namespace crowdface
