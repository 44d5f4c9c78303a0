// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/field_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/smooth/field_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway's order of includes: foreach_target.h first, then what is compiled once for each target.
#include <cmath>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 16>;

void narrow(const float* from, std::size_t count, float scale, std::int16_t* to) {
  const Lanes lanes;
  const hn::Rebind<std::int16_t, Lanes> narrow_lanes;
  const std::size_t width = hn::Lanes(lanes);
  const auto factor = hn::Set(lanes, scale);
  std::size_t i = 0;
  for (; i + width <= count; i += width) {
    const auto whole = hn::NearestInt(hn::Mul(hn::LoadU(lanes, from + i), factor));
    hn::StoreU(hn::DemoteTo(narrow_lanes, whole), narrow_lanes, to + i);
  }
  for (; i < count; ++i) to[i] = static_cast<std::int16_t>(std::nearbyint(from[i] * scale));
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(narrow);

void narrow(const float* from, std::size_t count, float scale, std::int16_t* to) {
  HWY_DYNAMIC_DISPATCH(narrow)(from, count, scale, to);
}

}  // namespace crowdface
#endif
