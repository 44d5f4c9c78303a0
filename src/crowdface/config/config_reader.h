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

/// What the command line changes in a config, as the user typed it.
struct ConfigOverrides {
  std::vector<std::string> set;          ///< `--set`: "key.path=value"; later ones win
  std::optional<std::string> count;      ///< `--count`, wins over `--set crowd.count`
  std::optional<std::string> seed;       ///< `--seed`
  std::optional<std::string> out;        ///< `--out`, relative to the working directory
  std::vector<std::string> review = {};  ///< `--review`, likewise; after those of the key `review`
  /// Reviews that the crowd's folder keeps: they come first, and none of them comes again.
  std::vector<std::filesystem::path> kept_reviews = {};
};

/// What could be read of a config, whatever is wrong with the rest.
struct ConfigReading {
  Config config;               ///< to be used only as far as the flags go
  bool complete = false;       ///< no problem at all
  bool heads_known = false;    ///< faces.files and faces.names
  bool regions_known = false;  ///< regions.names and regions.mask
};

/// Reads a config and checks all of it that can be checked without opening a mesh or an image.
/// docs/config.md is the reference. Adds every problem, in the order of the file: 64 for what is
/// wrong in the config, 66 for files and folders that are not there.
ConfigReading read_config_parts(const std::filesystem::path& file, const ConfigOverrides& overrides,
                                Problems& problems);

/// The same of a text, wherever it is from.
/// \param file  its name in messages, which need not be there; relative paths start at its folder.
ConfigReading read_config_text(std::string_view text, const std::filesystem::path& file,
                               const ConfigOverrides& overrides, Problems& problems);

/// A file's, for those who need all of it. \return nothing if there is any problem.
std::optional<Config> read_config(const std::filesystem::path& file,
                                  const ConfigOverrides& overrides, Problems& problems);

}  // namespace crowdface
