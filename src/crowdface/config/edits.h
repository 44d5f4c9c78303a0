// SPDX-License-Identifier: Apache-2.0
// The file that a config names as `edits`: recipes and regions that `crowdface edit` saved.
#pragma once

#include "crowdface/config/config_draft.h"
#include "crowdface/config/yaml.h"

namespace crowdface {

/// Puts each section of `edits` in place of the one in `root`. Recipes are added to those in `root`, or
/// replace the recipe with the same id.
void merge_edits(const YamlNode& edits, YamlNode& root);

/// Merges the file that the config names as `edits`, if it names one.
void read_edits(YamlNode& root, ConfigDraft& draft);

}  // namespace crowdface
