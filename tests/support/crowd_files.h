// SPDX-License-Identifier: Apache-2.0
// What lies in a crowd's folder, for tests that compare crowds.
#pragma once

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/temporary_folder.h"

namespace crowdface::testing {

/// Every file below the folder and its bytes, but for what may differ from run to run.
inline std::map<std::string, std::string> crowd_files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (!entry.is_regular_file() || name == "timings.json" || name == "crowdface.log") continue;
    files[name] = read_text(entry.path());
  }
  return files;
}

/// Where two folders' files differ: names only, so that a failure can be read.
inline std::vector<std::string> differing_files(const std::map<std::string, std::string>& a,
                                                const std::map<std::string, std::string>& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a) {
    if (const auto other = b.find(name); other == b.end() || other->second != bytes) {
      names.push_back(name);
    }
  }
  for (const auto& [name, bytes] : b) {
    if (a.find(name) == a.end()) names.push_back(name);
  }
  return names;
}

/// The lines of plan.jsonl.
inline std::vector<nlohmann::json> plan_lines(const std::filesystem::path& folder) {
  std::vector<nlohmann::json> lines;
  std::istringstream text(read_text(folder / "plan.jsonl"));
  for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

inline nlohmann::json read_json(const std::filesystem::path& path) {
  return nlohmann::json::parse(read_text(path));
}

}  // namespace crowdface::testing
