// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// What the heads, regions, bands and attachments of recipes are called, by their indices.
struct PlanNames {
  std::vector<std::string> heads;
  std::vector<std::string> regions;
  std::vector<std::string> bands = {};  ///< none: detail is one band
  /// What may sit on heads; none: recipes say nothing of that.
  std::vector<std::string> attachments = {};
};

inline const std::string& name_at(const std::vector<std::string>& names, Index i) {
  return names[static_cast<std::size_t>(i)];
}

}  // namespace crowdface
