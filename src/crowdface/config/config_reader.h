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

/// Options of a command line that change a config, as the user typed the options.
struct ConfigOverrides {
  /// `--set`: "key.path=value"; later values replace earlier values of the same key
  std::vector<std::string> assignments;
  std::optional<std::string> count;  ///< `--count`; replaces a value given by `--set crowd.count`
  std::optional<std::string> seed;   ///< `--seed`, the seed of the random numbers
  std::optional<std::string> out;    ///< `--out`; a path relative to the working directory
  /// `--review`; paths relative to the working directory. Read after the files that the key
  /// `review` lists.
  std::vector<std::string> review = {};
  /// `--without-reviews`: whether to ignore the reviews stored in the crowd's folder
  bool without_reviews = false;
  /// whether the run keeps and applies the reviews that are stored in the crowd's folder, even if
  /// the folder contains the crowd of another config
  bool keep_reviews_of_other_configs = false;
  /// Reviews stored in the crowd's folder. The program reads these reviews first. If the config
  /// lists a copy of one of these reviews, the copy is ignored.
  std::vector<std::filesystem::path> stored_reviews = {};
  /// Number of sampled faces of the crowd in the output folder. Stored reviews that do not state a
  /// number of faces get this number.
  std::optional<std::uint64_t> former_face_count = {};
  /// The `diversity.min_distance` with which the crowd in the output folder was made. Empty if the
  /// config has the same value. Stored reviews that do not state a distance get this distance.
  std::optional<double> former_min_distance_mm = {};
  /// Folder of reviews that are ignored even if the config lists them. Empty: no review is ignored.
  std::filesystem::path ignored_reviews_folder = {};
};

/// The result of reading a config. If there were problems, only parts of the config are valid.
struct ConfigReading {
  /// If there were problems, use only the parts that the flags below declare valid.
  Config config;
  bool is_complete = false;  ///< true if there was no problem, so that the whole config is valid
  /// whether `config.faces.files` and `config.faces.names` are valid
  bool are_heads_known = false;
  /// whether `config.regions.names` and `config.regions.mask` are valid
  bool are_regions_known = false;
  /// Warnings, one line each, for example about keys that other keys override. The warnings about
  /// overridden keys are present only if the config is complete.
  std::vector<std::string> warnings = {};
};

/// Reads a config file, and checks everything that can be checked without opening a mesh or an
/// image. If there are problems, the valid parts of the config can still be used. docs/config.md
/// describes all keys. Adds every problem to `problems`, in the order of the file; the exit code is
/// 64 for mistakes in the config and 66 for missing files and folders.
ConfigReading read_partial_config(const std::filesystem::path& file,
                                  const ConfigOverrides& overrides, Problems& problems);

/// Like read_partial_config, but reads the config from a text.
///
/// \param file  name of the text in messages. Relative paths start at the folder of this file,
///              which need not exist.
ConfigReading read_config_text(std::string_view text, const std::filesystem::path& file,
                               const ConfigOverrides& overrides, Problems& problems);

/// Like read_partial_config, but returns nothing if there was a problem.
std::optional<Config> read_config(const std::filesystem::path& file,
                                  const ConfigOverrides& overrides, Problems& problems);

}  // namespace crowdface
