// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/crowd_product_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/blend/crowd_product_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway's order of includes: foreach_target.h first, then what is compiled once for each target.
#include <algorithm>

#include "crowdface/core/fused_lanes-inl.h"

#include "hwy/cache_control.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Two vectors of values times six faces: twelve sums stay in registers.
void add_product(const float* chunk, const std::uint32_t* fields, std::size_t count,
                 const float* coefficients, const float* alpha, float* sums, std::size_t stride) {
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
    const V alpha_left = hn::LoadU(lanes, alpha + begin);
    const V alpha_right = hn::LoadU(lanes, alpha + begin + width);
    for (std::size_t face = 0; face < kChunkFaces; ++face) {
      float* sum = sums + face * stride + begin;
      hn::StoreU(hn::Add(hn::LoadU(lanes, sum), hn::Mul(alpha_left, left[face])), lanes, sum);
      sum += width;
      hn::StoreU(hn::Add(hn::LoadU(lanes, sum), hn::Mul(alpha_right, right[face])), lanes, sum);
    }
  }
}

/// Whole cache lines go out by streaming stores, what is left at both ends by common ones.
void write_sums(const double* base, const float* added, std::size_t count, double* results) {
  const hn::CappedTag<double, 8> lanes;
  const hn::Rebind<float, decltype(lanes)> narrow;
  constexpr std::size_t kLineBytes = 64, kLine = kLineBytes / sizeof(double);
  const std::size_t width = hn::Lanes(lanes);
  const std::size_t past_line = reinterpret_cast<std::uintptr_t>(results) % kLineBytes;
  std::size_t i = 0;
  const auto write_to = [&](std::size_t end) {
    for (; i < end; ++i) results[i] = base[i] + static_cast<double>(added[i]);
  };
  write_to(std::min(count, (kLineBytes - past_line) % kLineBytes / sizeof(double)));
  for (const std::size_t end = i + (count - i) / kLine * kLine; i < end; i += width) {
    const auto more = hn::PromoteTo(lanes, hn::LoadU(narrow, added + i));
    hn::Stream(hn::Add(hn::LoadU(lanes, base + i), more), lanes, results + i);
  }
  write_to(count);
}

void finish_writing() {
  hwy::FlushStream();
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(add_product);
HWY_EXPORT(write_sums);
HWY_EXPORT(finish_writing);

void add_product(const float* chunk, const std::uint32_t* fields, std::size_t count,
                 const float* coefficients, const float* alpha, float* sums, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(add_product)(chunk, fields, count, coefficients, alpha, sums, stride);
}

void write_sums(const double* base, const float* added, std::size_t count, double* results) {
  HWY_DYNAMIC_DISPATCH(write_sums)(base, added, count, results);
}

void finish_writing() {
  HWY_DYNAMIC_DISPATCH(finish_writing)();
}

}  // namespace crowdface
#endif
