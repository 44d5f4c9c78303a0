// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/complaints.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// A config half-way through reading. The sections are read from the top down, and each may use
/// what those before it found.
struct ConfigDraft {
  explicit ConfigDraft(Complaints& out) : complaints(out) { config.sampling.regions.resize(1); }

  Config config;
  Complaints& complaints;
  std::filesystem::path folder;  ///< of the config file; relative paths start there
  /// After a complaint about the heads, tags, regions or smoothing what they hold is not known, and
  /// values elsewhere are not held against it.
  bool heads_known = false;
  bool tags_known = true;
  bool regions_known = true;
  bool smoothing_known = true;
};

/// Which of part_names() are meant: by a region's name all its bands, by a band's that of all regions,
/// or one part. Empty if there is none of that name.
std::vector<std::size_t> find_parts(const std::string& name, const Config& config);

bool has_tags(const std::vector<std::string>& of_head, const std::vector<std::string>& tags);
/// The heads that have all of these tags.
std::vector<Eigen::Index> heads_with(const std::vector<std::string>& tags,
                                     const Config::Faces& faces);

/// A path relative to the folder, with "a/../" taken out by its text.
std::filesystem::path resolve(const std::filesystem::path& folder, const std::string& path);

/// Whether the file is there; a complaint if not. \param what  before the file's name.
bool expect_file(const YamlNode& node, const std::filesystem::path& file, ConfigDraft& draft,
                 std::string_view what = "the file ");

/// The head of that name; nothing after a complaint, or silently where the heads are not known.
std::optional<Eigen::Index> find_head(const std::string& name, const YamlPlace& place,
                                      const std::string& path, ConfigDraft& draft);
/// The head of that name, or all heads with that tag; empty after a complaint.
std::vector<Eigen::Index> find_heads(const std::string& name, const YamlPlace& place,
                                     const std::string& path, ConfigDraft& draft);

}  // namespace crowdface
