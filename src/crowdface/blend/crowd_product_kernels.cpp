// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/crowd_product_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/blend/crowd_product_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway's order of includes: foreach_target.h first, then what is compiled once for each target.
#include "crowdface/core/fused_lanes-inl.h"

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Two vectors of values times six faces: twelve sums stay in registers.
void multiply(const float* chunk, const std::uint32_t* fields, std::size_t count,
              const float* coefficients, float* products) {
  const hn::CappedTag<float, kChunkValues / 2> lanes;
  using V = hn::VFromD<decltype(lanes)>;
  const std::size_t width = hn::Lanes(lanes);
  for (std::size_t begin = 0; begin < kChunkValues; begin += 2 * width) {
    V left[kChunkFaces], right[kChunkFaces];
    for (std::size_t face = 0; face < kChunkFaces; ++face) {
      left[face] = right[face] = hn::Zero(lanes);
    }
    const float* factor = coefficients;
    for (std::size_t f = 0; f < count; ++f, factor += kChunkFaces) {
      const float* values = chunk + fields[f] * kChunkValues + begin;
      const V a = hn::Load(lanes, values), b = hn::Load(lanes, values + width);
      for (std::size_t face = 0; face < kChunkFaces; ++face) {
        const V c = hn::Set(lanes, factor[face]);
        left[face] = fused(c, a, left[face]);
        right[face] = fused(c, b, right[face]);
      }
    }
    for (std::size_t face = 0; face < kChunkFaces; ++face) {
      float* out = products + face * kChunkValues + begin;
      hn::StoreU(left[face], lanes, out);
      hn::StoreU(right[face], lanes, out + width);
    }
  }
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(multiply);

void multiply_chunk(const float* chunk, const std::uint32_t* fields, std::size_t count,
                    const float* coefficients, float* products) {
  HWY_DYNAMIC_DISPATCH(multiply)(chunk, fields, count, coefficients, products);
}

}  // namespace crowdface
#endif
