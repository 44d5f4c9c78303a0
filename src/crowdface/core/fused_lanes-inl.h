// SPDX-License-Identifier: Apache-2.0
// Vector operations with the same result bits on every instruction set. Kernels include this file
// after hwy/foreach_target.h, which compiles each kernel once per instruction set; therefore the
// file has Highway's include guard.
#if defined(CROWDFACE_FUSED_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CROWDFACE_FUSED_LANES_INL_H_
#undef CROWDFACE_FUSED_LANES_INL_H_
#else
#define CROWDFACE_FUSED_LANES_INL_H_
#endif

#include <cmath>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {

#if !HWY_NATIVE_FMA
/// Calls std::fma for every lane; for targets without a fused multiply-add instruction.
template <class V>
V multiply_add_lane_by_lane(V a, V b, V c) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::DFromV<V> lanes;
  using T = hn::TFromD<decltype(lanes)>;
  HWY_ALIGN T factors[2][HWY_MAX_BYTES / sizeof(T)];
  HWY_ALIGN T sums[HWY_MAX_BYTES / sizeof(T)];
  hn::Store(a, lanes, factors[0]);
  hn::Store(b, lanes, factors[1]);
  hn::Store(c, lanes, sums);
  for (size_t i = 0; i < hn::Lanes(lanes); ++i) {
    sums[i] = std::fma(factors[0][i], factors[1][i], sums[i]);
  }
  return hn::Load(lanes, sums);
}
#endif

/// a·b + c in every lane, rounded once. (Highway's MulAdd rounds twice on targets without a fused
/// multiply-add instruction.)
template <class V>
HWY_INLINE V fused_multiply_add(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hwy::HWY_NAMESPACE::MulAdd(a, b, c);
#else
  return multiply_add_lane_by_lane(a, b, c);
#endif
}

/// a·b − c in every lane, rounded once.
template <class V>
HWY_INLINE V fused_multiply_subtract(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hwy::HWY_NAMESPACE::MulSub(a, b, c);
#else
  return multiply_add_lane_by_lane(a, b, hwy::HWY_NAMESPACE::Neg(c));
#endif
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
