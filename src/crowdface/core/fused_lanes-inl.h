// SPDX-License-Identifier: Apache-2.0
// Vector operations whose bits are the same on every instruction set. Included by kernels that are
// compiled once for each, after hwy/foreach_target.h (no include guard but Highway's own).
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

/// a·b + c in every lane, rounded once. Highway's own MulAdd rounds twice on targets without the
/// instruction.
template <class V>
HWY_INLINE V fused(V a, V b, V c) {
#if HWY_TARGET == HWY_SCALAR
  return V(std::fma(a.raw, b.raw, c.raw));
#elif HWY_TARGET == HWY_EMU128
  V result;
  for (size_t i = 0; i < V::kPrivateN; ++i) result.raw[i] = std::fma(a.raw[i], b.raw[i], c.raw[i]);
  return result;
#else
  return hwy::HWY_NAMESPACE::MulAdd(a, b, c);
#endif
}

/// a·b − c in every lane, rounded once.
template <class V>
HWY_INLINE V fused_less(V a, V b, V c) {
#if HWY_TARGET == HWY_SCALAR
  return V(std::fma(a.raw, b.raw, -c.raw));
#elif HWY_TARGET == HWY_EMU128
  V result;
  for (size_t i = 0; i < V::kPrivateN; ++i) result.raw[i] = std::fma(a.raw[i], b.raw[i], -c.raw[i]);
  return result;
#else
  return hwy::HWY_NAMESPACE::MulSub(a, b, c);
#endif
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
