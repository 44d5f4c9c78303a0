// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/config/starter_facts.h"

namespace crowdface {

/// The text of a first config for these heads: short, every line explained, ready to run.
std::string starter_config(const StarterFacts& facts);

}  // namespace crowdface
