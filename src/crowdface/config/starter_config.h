// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "crowdface/config/complaints.h"
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
  std::vector<std::vector<std::string>> tags = {};                 ///< #heads, or empty
  /// folder of attachments that some head may wear, relative to the folder of the config; empty:
  /// none
  std::filesystem::path attachments = {};
};

/// Returns a first config for these heads: short, with comments, ready to run.
std::string starter_config(const StarterFacts& facts);

/// Checks attachments.yaml in a folder of attachments.
/// \param facts  names and tags of the heads.
/// \return whether some head may wear some of the attachments; false after a complaint.
bool has_attachments(const std::filesystem::path& folder, const StarterFacts& facts,
                     Complaints& complaints);

}  // namespace crowdface
