// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/config/config_reader.h"

namespace crowdface {

/// How many faces a job's heads hold at which distance, without casting a crowd: the table for
/// people. Writes estimate.csv and estimate.svg into the crowd's folder, and nothing else.
/// \param cache  folder of prepared heads.
std::string estimate(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
                     const std::filesystem::path& cache);

}  // namespace crowdface
