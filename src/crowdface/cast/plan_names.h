// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Names of the heads, regions, bands and attachments that recipes refer to by index.
struct PlanNames {
  std::vector<std::string> heads;
  std::vector<std::string> regions;
  std::vector<std::string> bands = {};  ///< names of the bands; empty: all detail is one band
  /// Names of the attachments. Empty if recipes have no attachments.
  std::vector<std::string> attachments = {};
  std::vector<std::string> traits = {};  ///< names of the measurements that a plan records
};

inline const std::string& name_at(const std::vector<std::string>& names, Index i) {
  return names[static_cast<std::size_t>(i)];
}

}  // namespace crowdface
