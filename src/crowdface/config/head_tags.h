// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config_draft.h"

namespace crowdface {

/// Reads a mapping from heads to their tags. Adds a complaint about each tag that is also a head's
/// name, `all` or `target`.
void read_head_tags(const YamlNode& node, Config::Faces& faces, ConfigDraft& draft);

/// Reads a mapping from heads to their ages in years.
void read_head_ages(const YamlNode& node, Config::Faces& faces, ConfigDraft& draft);

/// Reads tags and ages from the keys `faces.tags` and `faces.ages` of the file tags.yaml, in each
/// folder that contains heads. (`crowdface synth` and `crowdface import` write this file.) Ignores
/// names that are not heads of the config.
void read_tags_from_head_folders(Config::Faces& faces, ConfigDraft& draft);

/// Returns the tag of an age: "young" below 35 years, "adult" from 35 to below 55 years, and "old"
/// from 55 years on.
std::string_view age_class(double years);

/// Gives each head whose age is known the tag of this age (see age_class), unless the head already
/// has the tag `young`, `adult` or `old`.
void add_age_tags(Config::Faces& faces);

}  // namespace crowdface
