// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "crowdface/core/units.h"

namespace crowdface {

inline constexpr std::array kLengthUnits = {LengthUnit::kMillimetre, LengthUnit::kCentimetre,
                                            LengthUnit::kMetre, LengthUnit::kInch};

/// Of mm, cm and m the unit in which `length` is nearest to `typical_mm`, as a ratio.
LengthUnit nearest_unit(double length, double typical_mm);

}  // namespace crowdface
