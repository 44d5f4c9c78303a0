// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config_draft.h"

namespace crowdface {

/// Reads a mapping from heads to tags. Refuses tags that already mean something else in a config.
void read_head_tags(const YamlNode& node, Config::Faces& faces, ConfigDraft& draft);

/// Reads the tags from `faces.tags` of each tags.yaml in a folder of heads; `crowdface synth` and
/// `crowdface import` write this file. Ignores names that are not heads.
void read_tags_beside_heads(Config::Faces& faces, ConfigDraft& draft);

}  // namespace crowdface
