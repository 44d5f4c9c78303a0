// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/complaints.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// A config of which some sections have been read. Sections are read in the order of root_keys, and
/// each section may use the values of earlier sections.
struct ConfigDraft {
  /// \param out  becomes `complaints`; must outlive this object.
  explicit ConfigDraft(Complaints& out);

  Config config;                 ///< contains the sections read so far
  Complaints& complaints;        ///< receives every complaint about the config
  std::filesystem::path folder;  ///< folder of the config file; relative paths start here
  std::vector<std::filesystem::path> stored_reviews;  ///< see ConfigOverrides::stored_reviews
  std::optional<std::uint64_t> former_face_count;     ///< see ConfigOverrides::former_face_count
  /// see ConfigOverrides::former_min_distance_mm
  std::optional<double> former_min_distance_mm;
  /// see ConfigOverrides::ignored_reviews_folder
  std::filesystem::path ignored_reviews_folder;
  std::vector<std::string> warnings;  ///< see ConfigReading
  // Each of the next four members says whether one section is valid. A complaint about a section
  // sets the section's member to false. Values in other sections that refer to this section are
  // then not checked, so that one mistake gives only one message.
  bool are_heads_known = false;    ///< whether the section of the heads is valid
  bool are_tags_known = true;      ///< whether the heads' tags are valid
  bool are_regions_known = true;   ///< whether the section of the regions is valid
  bool is_smoothing_known = true;  ///< whether the section of the smoothing is valid
};

/// Returns the pairs of region and band that a name selects, as indices into region_band_names().
/// The name of a region selects all bands of the region. The name of a band selects this band in
/// all regions. A name such as "top/build" selects one pair. Returns an empty list for an unknown
/// name.
std::vector<std::size_t> find_region_bands(const std::string& name, const Config& config);

/// Returns whether the tags of a head contain all of `tags`.
bool has_tags(const std::vector<std::string>& head_tags, const std::vector<std::string>& tags);
/// Returns the heads that have all of these tags, ascending.
std::vector<Eigen::Index> heads_with_tags(const std::vector<std::string>& tags,
                                          const Config::Faces& faces);
/// Returns "; the heads have the tags adult, female, …" for messages about unknown tags.
std::string known_tags(const Config::Faces& faces);
/// Removes the tags that name an age: young, adult, old.
std::vector<std::string> remove_age_tags(std::vector<std::string> tags);

/// Resolves a path against the folder. Removes "a/../" by text alone, without following symbolic
/// links, and removes a '/' at the end.
std::filesystem::path resolve(const std::filesystem::path& folder, const std::string& path);

/// Returns whether a file exists. If the file is missing, adds a complaint of kind kMissingInput.
///
/// \param what  text that stands before the file's name in the message.
bool expect_file(const YamlNode& node, const std::filesystem::path& file, ConfigDraft& draft,
                 std::string_view what = "the file ");

/// Returns the head with this name. If there is no such head, returns nothing and adds a complaint.
/// Adds no complaint if the list of heads is invalid (`are_heads_known` is false).
std::optional<Eigen::Index> find_head(const std::string& name, const YamlPlace& place,
                                      const std::string& path, ConfigDraft& draft);
/// Returns the head that has this name, or all heads that have this tag. If there is no such head,
/// returns an empty list and adds a complaint. Adds no complaint if the heads or tags are invalid
/// (`are_heads_known` or `are_tags_known` is false).
std::vector<Eigen::Index> find_heads(const std::string& name, const YamlPlace& place,
                                     const std::string& path, ConfigDraft& draft);

}  // namespace crowdface
