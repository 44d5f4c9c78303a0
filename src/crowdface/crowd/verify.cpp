// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/verify.h"

#include <algorithm>
#include <map>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/ledger.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Reads one line for each item from the ledgers in the folder. If an item has several lines,
/// returns the last line that matches the existing files. If no line matches, returns the last
/// line.
std::map<std::string, LedgerEntry> read_ledgers(const CrowdDirectory& directory,
                                                CrowdCheck& check) {
  std::map<std::string, std::vector<LedgerEntry>> all;
  for (const fs::path& path : directory.ledgers()) {
    LedgerLines lines = read_ledger(path);
    if (lines.damaged_count > 0) {
      check.remarks.push_back(
          concat(path.filename().string(), ": ", lines.damaged_count,
                 lines.damaged_count == 1 ? " line is damaged" : " lines are damaged"));
    }
    if (path == directory.ledger() && !lines.is_complete) {
      check.remarks.push_back(
          concat(path.filename().string(), ": lines are missing, or no run has finished yet"));
    }
    for (LedgerEntry& entry : lines.entries) all[entry.item].push_back(std::move(entry));
  }
  std::map<std::string, LedgerEntry> entries;
  for (auto& [item, lines] : all) {
    throw_if_interrupted();
    const auto is_good = [&](const LedgerEntry& line) { return files_match(directory.root, line); };
    const auto good =
        lines.size() == 1 ? lines.rbegin() : std::find_if(lines.rbegin(), lines.rend(), is_good);
    entries[item] = std::move(good == lines.rend() ? lines.back() : *good);
  }
  return entries;
}

void compare_files(const CrowdDirectory& directory,
                   const std::map<std::string, LedgerEntry>& entries, CrowdCheck& check) {
  std::vector<const LedgerEntry::File*> files;
  for (const auto& [item, entry] : entries) {
    for (const LedgerEntry::File& file : entry.files) files.push_back(&file);
  }
  std::vector<char> good(files.size());
  Progress progress("checking files", files.size());
  parallel_for_each(files.size(), [&](std::size_t f) {
    throw_if_interrupted();
    good[f] = has_content(directory.root / files[f]->name, files[f]->content);
    progress.step();
  });
  check.file_count = files.size();
  for (std::size_t f = 0; f < files.size(); ++f) {
    if (good[f] != 0) continue;
    auto& list =
        is_file(directory.root / files[f]->name) ? check.altered_files : check.missing_files;
    list.push_back(files[f]->name);
  }
}

}  // namespace

CrowdCheck verify_crowd(const fs::path& crowd_directory) {
  const CrowdDirectory directory{crowd_directory};
  require_crowd(directory);
  CrowdCheck check;
  const auto entries = read_ledgers(directory, check);
  compare_files(directory, entries, check);
  if (path_exists(directory.plan())) {
    for (const std::string& id : ids_in_plan(directory)) {
      if (!entries.contains(concat("faces/", id))) check.unfinished_items.push_back(id);
    }
  }
  for (const fs::path& path : {directory.plan(), directory.report()}) {
    const std::string name = path.filename().string();
    if (!entries.contains(name)) check.unfinished_items.push_back(name);
  }
  if (!directory.shard_ledgers().empty()) {
    check.remarks.emplace_back("shards have not been gathered");
  }
  return check;
}

}  // namespace crowdface
