// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace crowdface {

/// A crowd's folder against its ledger. Empty lists: all is as it was written.
struct CrowdCheck {
  std::size_t files = 0;                ///< that the ledger knows
  std::vector<std::string> missing;     ///< files that are gone, relative to the folder
  std::vector<std::string> altered;     ///< files with other bytes
  std::vector<std::string> unfinished;  ///< what the plan names and no line of the ledger proves
  std::vector<std::string> remarks;     ///< what is wrong with the ledger itself, or left over

  bool good() const {
    return missing.empty() && altered.empty() && unfinished.empty() && remarks.empty();
  }
};

/// Reads every file of a crowd once and changes nothing. Needs neither heads nor masks.
/// \throws MissingInput if the folder holds no crowd; Interrupted.
CrowdCheck verify_crowd(const std::filesystem::path& crowd_directory);

}  // namespace crowdface
