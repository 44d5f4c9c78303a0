// SPDX-License-Identifier: Apache-2.0
// Lists of heads, as the keys `targets` and `sources` name them.
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/codec.h"
#include "crowdface/config/config_draft.h"

namespace crowdface {

/// Heads by name or tag; all of them for `all`. \return  ascending, each once
std::vector<Eigen::Index> read_head_list(const YamlNode& node, ConfigDraft& draft);
std::string write_head_list(const std::vector<Eigen::Index>& heads, const ConfigWriting& writing);

/// The same, or `{name: weight}`.
void read_targets(const YamlNode& node, SamplingOptions& sampling, ConfigDraft& draft);
std::string write_targets(const SamplingOptions& sampling, const ConfigWriting& writing);

}  // namespace crowdface
