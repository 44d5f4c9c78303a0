// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace crowdface {

/// Result of comparing a crowd's folder with its ledger. All lists are empty if no file has changed
/// since the crowd was written.
struct CrowdCheck {
  std::size_t file_count = 0;  ///< number of files in the ledger
  /// paths of files that are missing, relative to the crowd's folder
  std::vector<std::string> missing_files;
  /// paths of files whose content differs from the ledger, relative to the crowd's folder
  std::vector<std::string> altered_files;
  /// Items that are not finished, because no ledger lists them. An item is the id of a planned
  /// face, or the name of the plan file or of the report file.
  std::vector<std::string> unfinished_items;
  /// messages about damaged or incomplete ledgers, and about shards that were not gathered
  std::vector<std::string> remarks;

  bool is_intact() const {
    return missing_files.empty() && altered_files.empty() && unfinished_items.empty() &&
           remarks.empty();
  }
};

/// Reads every file of a crowd once and changes nothing. Needs neither heads nor masks.
/// \throws MissingInput if the folder holds no crowd; Interrupted.
CrowdCheck verify_crowd(const std::filesystem::path& crowd_directory);

}  // namespace crowdface
