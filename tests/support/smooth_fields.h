// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "crowdface/smooth/field_patches.h"

namespace crowdface::testing {

/// Five fields of a head on a grid, waves from ten long to a tenth high that die out with the level; the first column
/// of vertices stands still.
inline HeadSmoothing smooth_levels(Index columns, Index rows, std::size_t head) {
  constexpr int kFields = 5;
  std::vector<float> fields;
  for (int p = 0; p < kFields; ++p) {
    const double size = std::pow(10.0, 1 - 0.5 * p), turn = static_cast<double>(head) + p;
    for (Index v = 0; v < columns * rows; ++v) {
      const double x = static_cast<double>(v % columns) / static_cast<double>(columns);
      const double y = static_cast<double>(v / columns) / static_cast<double>(rows);
      for (int c = 0; c < 3; ++c) {
        const double wave = std::sin((2 + p) * (x + 0.7 * c) + turn) * std::cos((3 - c) * y + turn);
        fields.push_back(static_cast<float>(x * size * wave));
      }
    }
  }
  return {quantize(fields, columns * rows), [](std::uint64_t level) {
            std::vector<double> functions;
            for (int p = 0; p < kFields; ++p) {
              functions.push_back(1 - std::exp(-static_cast<double>(level) / (5 << p)));
            }
            return functions;
          }};
}

}  // namespace crowdface::testing
