// SPDX-License-Identifier: Apache-2.0
// The file of edits, which the config key `edits` names. The file contains recipes, regions and
// heads that `crowdface edit` saved.
#pragma once

#include "crowdface/config/config_draft.h"
#include "crowdface/config/yaml.h"

namespace crowdface {

/// Appends the heads that the edits list under `faces.also` to the config's section `faces`.
void merge_faces_section(const YamlNode& faces, YamlNode& config_faces);

/// Merges edits into the config `root`. A section of the edits replaces the same section of `root`,
/// with two exceptions: `faces` (see merge_faces_section) and `recipes`. A recipe of the edits
/// replaces the recipe with the same id. If no recipe has this id, the recipe is appended.
void merge_edits(const YamlNode& edits, YamlNode& root);

/// If the config has the key `edits`, merges the file that the key names into `root`.
void read_edits(YamlNode& root, ConfigDraft& draft);

}  // namespace crowdface
