// SPDX-License-Identifier: Apache-2.0
// The key `traits`, which the crowd, groups, recipes and families have.
#pragma once

#include "crowdface/config/codec.h"
#include "crowdface/traits/trait_limits.h"

namespace crowdface {

/// Codec for limits on measurements: `{nose_width: {at_least: 38 mm}, intercanthal: [0 %, 30 %]}`.
/// Empty limits are not written.
Codec<TraitLimits> trait_limits();

/// Reads a table of distributions. Each line of the table consists of a measurement, its mean and
/// its standard deviation, separated by commas. Adds complaints at `node`.
std::vector<TraitTarget> read_trait_table(const YamlNode& node, const std::filesystem::path& file,
                                          ConfigDraft& draft);

}  // namespace crowdface
