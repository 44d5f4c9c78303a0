// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config_draft.h"

namespace crowdface {

/// Reads a mapping from heads to their tags. Adds a complaint about tags that already mean
/// something else in a config.
void read_head_tags(const YamlNode& node, Config::Faces& faces, ConfigDraft& draft);

/// Reads tags from the key `faces.tags` of the file tags.yaml, in each folder that contains heads.
/// (`crowdface synth` and `crowdface import` write this file.) Ignores names that are not heads of
/// the config.
void read_tags_from_head_folders(Config::Faces& faces, ConfigDraft& draft);

}  // namespace crowdface
