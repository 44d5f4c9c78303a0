// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/config/config_values.h"

namespace crowdface {

/// A config half-way through reading. The sections are read from the top down, and each may use
/// what those before it found.
struct ConfigDraft {
  explicit ConfigDraft(Complaints& out) : complaints(out) {}

  Config config;
  Complaints& complaints;
  std::filesystem::path folder;  ///< of the config file; relative paths start there
  /// After a complaint about the heads, tags or regions their names are not known, and names
  /// elsewhere are not held against them.
  bool heads_known = false;
  bool tags_known = true;
  bool regions_known = false;
  std::optional<double> largest_size_mm;         ///< of a smoothness; none: not known here
  std::optional<std::uint64_t> most_iterations;  ///< likewise
};

/// Each reads one key of the root: its values into the draft, what is wrong into its complaints.
/// `node` is null if the key is not there.
void read_faces(const YamlNode* node, ConfigDraft& draft);
void read_regions(const YamlNode* node, ConfigDraft& draft);
void read_parts(const YamlNode* node, ConfigDraft& draft);
void read_plane(const YamlNode* node, ConfigDraft& draft);
void read_sampling(const YamlNode* node, ConfigDraft& draft);
void read_believability(const YamlNode* node, ConfigDraft& draft);
void read_recipes(const YamlNode* node, ConfigDraft& draft);
void read_families(const YamlNode* node, ConfigDraft& draft);
void read_review(const YamlNode* node, ConfigDraft& draft);
void read_output(const YamlNode* node, ConfigDraft& draft);

void read_contact_sheet(const YamlNode* node, ConfigDraft& draft);
void read_surfaces(const YamlNode* node, ConfigDraft& draft);

/// A path relative to the folder, with "a/../" taken out by its text.
std::filesystem::path resolve(const std::filesystem::path& folder, const std::string& path);

bool file_exists(const std::filesystem::path& path);

/// The head of that name; nothing after a complaint, or silently where the heads are not known.
std::optional<Eigen::Index> find_head(const std::string& name, const YamlPlace& place,
                                      const std::string& path, ConfigDraft& draft);
/// The head of that name, or all heads with that tag; empty after a complaint.
std::vector<Eigen::Index> find_heads(const std::string& name, const YamlPlace& place,
                                     const std::string& path, ConfigDraft& draft);

/// A smoothness as fraction or size, or as range of either.
std::optional<SmoothnessDistribution> read_smoothness(const YamlNode& node, ConfigDraft& draft);
/// Whole iterations or a range of them.
std::optional<SmoothnessDistribution> read_iterations(const YamlNode& node, ConfigDraft& draft);
/// An age from −1 to 1 or a range of them; complains if no head is tagged so.
std::optional<Range> read_age(const YamlNode& node, ConfigDraft& draft);
/// A review file. Its problems are complaints at their places in it.
Review read_review_file(const std::filesystem::path& file, const YamlNode& where,
                        ConfigDraft& draft);
/// An extrapolation factor or a range of them.
std::optional<Range> read_extrapolation(const YamlNode& node, ConfigDraft& draft);

}  // namespace crowdface
