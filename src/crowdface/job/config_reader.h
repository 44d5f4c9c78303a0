// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/core/problems.h"
#include "crowdface/job/config.h"

namespace crowdface {

/// What the command line changes in a config, as the user typed it.
struct ConfigOverrides {
  std::vector<std::string> set;      ///< `--set`: "key.path=value"; later ones win
  std::optional<std::string> count;  ///< `--count`, wins over `--set crowd.count`
  std::optional<std::string> seed;   ///< `--seed`
  std::optional<std::string> out;    ///< `--out`, relative to the working directory
};

/// Reads a config and checks all of it that can be checked without opening a mesh or an image.
/// docs/config.md is the reference. Adds every problem, in the order of the file: 64 for what is
/// wrong in the config, 66 for files and folders that are not there.
/// \return nothing if there is any problem.
std::optional<Config> read_config(const std::filesystem::path& file,
                                  const ConfigOverrides& overrides, Problems& problems);

}  // namespace crowdface
