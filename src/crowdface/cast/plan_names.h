// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace crowdface {

/// What the heads, regions, bands and attachments of recipes are called, by their indices.
struct PlanNames {
  std::vector<std::string> heads;
  std::vector<std::string> regions;
  std::vector<std::string> bands = {};  ///< none: detail is one band
  /// What may sit on heads; none: recipes say nothing of that.
  std::vector<std::string> attachments = {};
};

}  // namespace crowdface
