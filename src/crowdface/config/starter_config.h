// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "crowdface/config/complaints.h"
#include "crowdface/config/yaml_node.h"
#include "crowdface/core/units.h"

namespace crowdface {

/// What `crowdface init` knows about a folder of heads.
struct StarterFacts {
  std::filesystem::path heads;     ///< the folder, relative to where the config will be written
  std::vector<std::string> names;  ///< of the heads
  LengthUnit units = LengthUnit::kCentimetre;  ///< a guess
  std::string units_reason;                    ///< "the first mesh is 27.3 units high"
  double head_height = 0;                      ///< of the first head, in its own units
  Eigen::Index vertices = 0;                   ///< of each head
  Axis up = {1, 1};
  Axis front = {2, 1};
  std::string crowd_name = "crowd";
  std::string mask;  ///< of three bands, from the config's folder; empty: none
  std::vector<std::string> regions = {"top", "middle",
                                      "bottom"};  ///< what the mask's bands are called
  std::vector<std::pair<std::string, std::vector<std::string>>> tags = {};  ///< heads and theirs
  std::string attachments = {};  ///< that section, from starter_attachments; empty: there is none
};

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
