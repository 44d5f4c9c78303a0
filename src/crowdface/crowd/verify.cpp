// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/verify.h"

#include <algorithm>
#include <map>
#include <system_error>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/ledger.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

enum class State { kGood, kMissing, kAltered };

State state_of(const fs::path& path, const FileDigest& expected) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return State::kMissing;
  return holds(path, expected) ? State::kGood : State::kAltered;
}

/// A line of each item in all ledgers of the folder: of several, one that the files agree with, else
/// the last.
std::map<std::string, LedgerEntry> read_ledgers(const CrowdDirectory& directory,
                                                CrowdCheck& check) {
  LinesOfItems all;
  for (const fs::path& path : directory.ledgers()) {
    LedgerLines lines = read_ledger(path);
    if (lines.damaged > 0) {
      check.remarks.push_back(
          concat(path.filename().string(), ": ", lines.damaged,
                 lines.damaged == 1 ? " line is not whole" : " lines are not whole"));
    }
    if (path == directory.ledger() && !lines.complete) {
      check.remarks.push_back(concat(path.filename().string(),
                                     ": lines are missing, or no run has come to its end yet"));
    }
    add_lines(std::move(lines), all);
  }
  std::map<std::string, LedgerEntry> entries;
  for (auto& [item, lines] : all) {
    throw_if_interrupted();
    const auto good = lines.size() == 1 ? lines.rend()
                                        : std::find_if(lines.rbegin(), lines.rend(),
                                                       [&](const LedgerEntry& line) {
                                                         return files_match(directory.root, line);
                                                       });
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
  std::vector<State> states(files.size());
  Progress progress("checking files", files.size());
  parallel_for_each(static_cast<std::ptrdiff_t>(files.size()), [&](std::ptrdiff_t i) {
    throw_if_interrupted();
    const auto f = static_cast<std::size_t>(i);
    states[f] = state_of(directory.root / files[f]->name, files[f]->content);
    progress.step();
  });
  check.files = files.size();
  for (std::size_t f = 0; f < files.size(); ++f) {
    if (states[f] == State::kMissing) check.missing.push_back(files[f]->name);
    if (states[f] == State::kAltered) check.altered.push_back(files[f]->name);
  }
}

}  // namespace

CrowdCheck verify_crowd(const fs::path& crowd_directory) {
  const CrowdDirectory directory{crowd_directory};
  std::error_code ignored;
  if (!fs::exists(directory.config(), ignored)) {
    throw MissingInput(
        concat(directory.config().string(), ": not there; expected a crowd's folder"));
  }
  CrowdCheck check;
  const auto entries = read_ledgers(directory, check);
  compare_files(directory, entries, check);
  if (fs::exists(directory.plan(), ignored)) {
    for (const std::string& id : ids_in_plan(directory)) {
      if (!entries.contains(concat("faces/", id))) check.unfinished.push_back(id);
    }
  }
  for (const fs::path& path : {directory.plan(), directory.report()}) {
    const std::string name = path.filename().string();
    if (!entries.contains(name)) check.unfinished.push_back(name);
  }
  if (!directory.shard_ledgers().empty()) {
    check.remarks.emplace_back("shards have not been gathered");
  }
  return check;
}

}  // namespace crowdface
