// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/cast/estimate.h"
#include "crowdface/config/config_reader.h"

namespace crowdface {

/// How many faces a job's heads hold at which distance, without casting a crowd: the table for
/// people. Writes estimate.csv and estimate.svg into the crowd's folder, and nothing else.
/// \param cache  folder of prepared heads.
std::string estimate(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
                     const std::filesystem::path& cache);

/// The table with columns for people to read.
std::string format_estimate(const std::vector<EstimateRow>& rows, std::uint64_t asked_count,
                            double asked_mm);

/// A plot as SVG: faces across (each decade the same width), millimetres upwards, one line a mode,
/// and what is asked for as a cross.
std::string plot_estimate(const std::vector<EstimateRow>& rows, std::uint64_t asked_count,
                          double asked_mm);

}  // namespace crowdface
