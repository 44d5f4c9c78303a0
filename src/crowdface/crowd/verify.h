// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace crowdface {

/// Result of comparing a crowd's folder with its ledger. All lists are empty if the folder is as it
/// was written.
struct CrowdCheck {
  std::size_t files = 0;                ///< number of files in the ledger
  std::vector<std::string> missing;     ///< missing files, relative to the folder
  std::vector<std::string> altered;     ///< files with other content
  std::vector<std::string> unfinished;  ///< items of the plan that no ledger line proves
  std::vector<std::string> remarks;     ///< problems of the ledger itself, and leftovers

  bool is_intact() const {
    return missing.empty() && altered.empty() && unfinished.empty() && remarks.empty();
  }
};

/// Reads every file of a crowd once and changes nothing. Needs neither heads nor masks.
/// \throws MissingInput if the folder holds no crowd; Interrupted.
CrowdCheck verify_crowd(const std::filesystem::path& crowd_directory);

}  // namespace crowdface
