// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "crowdface/config/complaints.h"
#include "crowdface/core/units.h"

namespace crowdface {

/// What `crowdface init` has found out about a folder of heads.
struct StarterFacts {
  std::filesystem::path heads_folder;   ///< folder of the heads, relative to the config's folder
  std::vector<std::string> head_names;  ///< name of each head
  LengthUnit units = LengthUnit::kCentimetre;  ///< unit of the heads' positions, which is guessed
  /// why this unit was guessed, such as "the first mesh is 27.3 units high"
  std::string units_reason;
  double head_height = 0;         ///< height of the first head, in the head's own units
  Eigen::Index vertex_count = 0;  ///< number of vertices of each head
  Axis up = {1, 1};               ///< direction from chin to crown
  Axis front = {2, 1};            ///< direction in which the faces look
  /// whether the written config has `align: rigid`, because some heads are rotated or shifted
  /// relative to the other heads
  bool uses_rigid_alignment = false;
  std::string crowd_name = "crowd";
  std::string mask_file;  ///< region mask, relative to the config's folder; empty: none
  std::vector<std::string> regions = {"top", "middle", "bottom"};  ///< names of the mask's channels
  /// for each head: its tags; empty if the starter config has no tags
  std::vector<std::vector<std::string>> tags = {};
  /// folder of attachments, relative to the config's folder; empty: there are no attachments that a
  /// head may wear
  std::filesystem::path attachments_folder = {};
};

/// Returns a config with which users can start: it is short, has comments, and can be run without
/// changes.
std::string starter_config(const StarterFacts& facts);

/// Checks the file attachments.yaml in a folder of attachments.
///
/// \param facts  names and tags of the heads.
/// \return whether at least one head may wear at least one of the attachments; false after a
///         complaint.
bool has_attachments(const std::filesystem::path& folder, const StarterFacts& facts,
                     Complaints& complaints);

}  // namespace crowdface
