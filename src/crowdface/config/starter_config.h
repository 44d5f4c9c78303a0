// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/config/complaints.h"
#include "crowdface/config/starter_facts.h"
#include "crowdface/config/yaml_node.h"

namespace crowdface {

/// The text of a first config for these heads: short, every line explained, ready to run.
std::string starter_config(const StarterFacts& facts);

/// The section `attachments` of a file that lies beside heads, without what none of them may wear, its
/// files named from where the config will be written. Empty if nothing is left, or after a complaint.
/// \param section  what stands under `attachments`; files in it relative to `heads`.
/// \param facts    names and tags of the heads.
/// \param heads, config_folder  absolute.
std::string starter_attachments(const YamlNode& section, const StarterFacts& facts,
                                const std::filesystem::path& heads,
                                const std::filesystem::path& config_folder, Complaints& complaints);

}  // namespace crowdface
