// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config.h"

namespace crowdface {

std::vector<std::string> Config::region_names() const {
  return regions.names.empty() ? std::vector<std::string>{"all"} : regions.names;
}

PlanNames Config::plan_names() const {
  return {faces.names, region_names()};
}

}  // namespace crowdface
