// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"

namespace crowdface {

/// Command-line options that change a config, as the user typed them.
struct ConfigOverrides {
  std::vector<std::string> assignments;  ///< `--set`: "key.path=value"; later ones win
  std::optional<std::string> count;      ///< `--count`, wins over `--set crowd.count`
  std::optional<std::string> seed;       ///< `--seed`
  std::optional<std::string> out;        ///< `--out`, relative to the working directory
  std::vector<std::string> review = {};  ///< `--review`, relative to the working directory; read
                                         ///< after the files of the key `review`
  /// `--without-reviews`: the reviews stored in the crowd's folder do not apply
  bool without_reviews = false;
  /// the stored reviews apply even if the folder holds another config's crowd
  bool keep_reviews_of_other_configs = false;
  /// Reviews stored in the crowd's folder. They are read first; a later copy is ignored.
  std::vector<std::filesystem::path> kept_reviews = {};
  /// The crowd's number of sampled faces, for kept reviews that do not state it.
  std::optional<std::uint64_t> kept_face_count = {};
  /// The crowd's `diversity.min_distance`, for kept reviews that do not state a distance, if the
  /// config's distance differs.
  std::optional<double> kept_min_distance_mm = {};
  /// Reviews in this folder are not read; empty: all reviews are read.
  std::filesystem::path ignored_reviews = {};
};

/// A config that may be read only in part because of problems.
struct ConfigReading {
  /// if there were problems, only the parts that the flags declare valid may be used
  Config config;
  bool is_complete = false;    ///< there was no problem; the whole config is valid
  bool heads_known = false;    ///< faces.files and faces.names are valid
  bool regions_known = false;  ///< regions.names and regions.mask are valid
  /// Keys of a complete config that other keys override, a line for each.
  std::vector<std::string> warnings = {};
};

/// Reads a config and checks everything that can be checked without opening a mesh or an image.
/// docs/config.md is the reference. Adds every problem in the order of the file, with exit code 64
/// for mistakes in the config and 66 for missing files and folders.
ConfigReading read_config_parts(const std::filesystem::path& file, const ConfigOverrides& overrides,
                                Problems& problems);

/// Like read_config_parts, but reads the config from a text.
/// \param file  name in messages, need not exist; relative paths start at its folder.
ConfigReading read_config_text(std::string_view text, const std::filesystem::path& file,
                               const ConfigOverrides& overrides, Problems& problems);

/// Like read_config_parts, but returns nothing if there is any problem.
std::optional<Config> read_config(const std::filesystem::path& file,
                                  const ConfigOverrides& overrides, Problems& problems);

}  // namespace crowdface
