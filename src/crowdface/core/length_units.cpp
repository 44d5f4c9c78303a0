// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/length_units.h"

#include <algorithm>

namespace crowdface {

LengthUnit nearest_unit(double length, double typical_mm) {
  const auto distance = [&](LengthUnit unit) {
    const double ratio = std::max(length * mm_per(unit), 1e-9) / typical_mm;
    return std::max(ratio, 1 / ratio);
  };
  return std::min({LengthUnit::kMillimetre, LengthUnit::kCentimetre, LengthUnit::kMetre},
                  [&](LengthUnit a, LengthUnit b) { return distance(a) < distance(b); });
}

}  // namespace crowdface
