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
  std::filesystem::path heads;     ///< folder of the heads, relative to the folder of the config
  std::vector<std::string> names;  ///< #heads
  LengthUnit units = LengthUnit::kCentimetre;  ///< a guess
  std::string units_reason;                    ///< "the first mesh is 27.3 units high"
  double head_height = 0;                      ///< height of the first head, in its own units
  Eigen::Index vertices = 0;                   ///< number of vertices of each head
  Axis up = {1, 1};
  Axis front = {2, 1};
  bool align_rigidly = false;  ///< some heads are rotated or shifted relative to the others
  std::string crowd_name = "crowd";
  std::string mask;  ///< region mask, relative to the folder of the config; empty: none
  std::vector<std::string> regions = {"top", "middle", "bottom"};  ///< names of the mask's channels
  std::vector<std::pair<std::string, std::vector<std::string>>> tags = {};  ///< head, its tags
  std::string attachments = {};  ///< text from starter_attachments; empty: no such section
};

/// Returns a first config for these heads: short, with comments, ready to run.
std::string starter_config(const StarterFacts& facts);

/// Adapts the section `attachments` of a file in the folder of the heads: removes the items that no
/// head may wear and makes file paths relative to the config. Returns an empty text if no item
/// remains, or after a complaint.
/// \param section  the value of `attachments`; its file paths are relative to `heads`.
/// \param facts    names and tags of the heads.
/// \param heads, config_folder  absolute folders of the heads and of the config.
std::string starter_attachments(const YamlNode& section, const StarterFacts& facts,
                                const std::filesystem::path& heads,
                                const std::filesystem::path& config_folder, Complaints& complaints);

}  // namespace crowdface
