// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "crowdface/synth/identity.h"

namespace crowdface::synth {

/// One independent measure of a head: how it moves the skin for a value of 1 (one standard
/// deviation), and how much of its average hangs on the person.
struct Measure {
  std::string_view name;
  double male, aged, build;  ///< the average's change for each
  double spread;             ///< of what is drawn around it
  Pull pull;
};
std::span<const Measure> measures();

}  // namespace crowdface::synth
