// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/config/config_reader.h"

namespace crowdface {

/// Estimates, without casting a crowd, the number of faces that the job's heads allow for each of
/// several minimum distances. Writes estimate.csv and estimate.svg into the crowd's folder, and no
/// other file.
/// \param cache  folder of prepared heads
/// \return a readable table.
std::string estimate(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
                     const std::filesystem::path& cache);

}  // namespace crowdface
