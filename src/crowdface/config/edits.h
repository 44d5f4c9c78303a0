// SPDX-License-Identifier: Apache-2.0
// The file of the config key `edits`: recipes, regions and heads that `crowdface edit` saved.
#pragma once

#include "crowdface/config/config_draft.h"
#include "crowdface/config/yaml.h"

namespace crowdface {

/// Appends the heads listed under `faces.also` of the edits to the heads of the config's `faces`.
void merge_faces(const YamlNode& faces, YamlNode& own);

/// Replaces each section of `root` by the section in `edits`, except `faces`, see merge_faces, and
/// `recipes`: each edited recipe replaces the recipe with the same id, or is appended.
void merge_edits(const YamlNode& edits, YamlNode& root);

/// Merges the file of the key `edits` into `root`, if the config has that key.
void read_edits(YamlNode& root, ConfigDraft& draft);

}  // namespace crowdface
