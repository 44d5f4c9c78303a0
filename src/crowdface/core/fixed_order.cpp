// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/fixed_order.h"

#include <algorithm>

namespace crowdface {

double fixed_dot(const float* a, const float* b, std::ptrdiff_t size) {
  constexpr std::ptrdiff_t kLanes = 16, kChunk = 64 * kLanes;
  double sum = 0;
  for (std::ptrdiff_t begin = 0; begin < size; begin += kChunk) {
    const std::ptrdiff_t end = std::min(begin + kChunk, size);
    float lanes[kLanes] = {};
    std::ptrdiff_t i = begin;
    for (; i + kLanes <= end; i += kLanes) {
      for (std::ptrdiff_t l = 0; l < kLanes; ++l) lanes[l] += a[i + l] * b[i + l];
    }
    for (std::ptrdiff_t l = 0; i < end; ++i, ++l) lanes[l] += a[i] * b[i];
    for (const float lane : lanes) sum += static_cast<double>(lane);
  }
  return sum;
}

}  // namespace crowdface
