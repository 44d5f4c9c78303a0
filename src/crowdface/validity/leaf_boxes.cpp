// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/leaf_boxes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/validity/leaf_boxes.cpp"
#include "hwy/foreach_target.h"
// Highway's order of includes: foreach_target.h first, then what is compiled once for each target.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

std::uint64_t overlapping_boxes(const LeafBoxes& a, const LeafBoxes& b) {
  constexpr std::size_t kCount = LeafBoxes::kCount;
  const hn::CappedTag<float, kCount> lanes;
  std::uint64_t all = 0;
  for (std::size_t begin = 0; begin < kCount; begin += hn::Lanes(lanes)) {
    hn::VFromD<decltype(lanes)> low[3], high[3];
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = hn::LoadU(lanes, &b.low[c][begin]);
      high[c] = hn::LoadU(lanes, &b.high[c][begin]);
    }
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto along = [&](std::size_t c) {
        return hn::And(hn::Le(hn::Set(lanes, a.low[c][i]), high[c]),
                       hn::Le(low[c], hn::Set(lanes, a.high[c][i])));
      };
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(lanes, hn::And(hn::And(along(0), along(1)), along(2)), bits);
      all |= std::uint64_t{bits[0]} << (kCount * i + begin);
    }
  }
  return all;
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(overlapping_boxes);

std::uint64_t overlapping(const LeafBoxes& a, const LeafBoxes& b) {
  return HWY_DYNAMIC_DISPATCH(overlapping_boxes)(a, b);
}

/// Without branches, which no processor foresees here.
bool overlap(const Box& a, const Box& b) {
  unsigned apart = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    apart |= static_cast<unsigned>(a.low[c] > b.high[c]);
    apart |= static_cast<unsigned>(b.low[c] > a.high[c]);
  }
  return apart == 0;
}

LeafBoxes::LeafBoxes(std::span<const std::uint32_t> numbers, std::span<const Triangle> triangles,
                     const Positions& positions, double margin) {
  constexpr float kEnd = std::numeric_limits<float>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    low[c].fill(kEnd);
    high[c].fill(-kEnd);
    const auto axis = static_cast<Index>(c);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const Triangle& t = triangles[numbers[i]];
      const double x = positions(t[0], axis), y = positions(t[1], axis), z = positions(t[2], axis);
      const auto least = static_cast<float>(std::min({x, y, z}) - margin);
      const auto most = static_cast<float>(std::max({x, y, z}) + margin);
      low[c][i] = least - 1e-6F * std::abs(least);
      high[c][i] = most + 1e-6F * std::abs(most);
    }
  }
}

Box LeafBoxes::whole() const {
  Box box;
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] = *std::min_element(low[c].begin(), low[c].end());
    box.high[c] = *std::max_element(high[c].begin(), high[c].end());
  }
  return box;
}

}  // namespace crowdface
#endif  // HWY_ONCE
