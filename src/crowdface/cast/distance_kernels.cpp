// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/distance_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/cast/distance_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway's order of includes: foreach_target.h first, then what is compiled once for each target.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 16>;

bool add_squares(const float* query, const float* rows, std::size_t dimensions, float bound,
                 float* sums) {
  constexpr std::size_t kLanes = 16;
  const Lanes lanes;
  bool within = false;
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(lanes)) {
    auto sum = hn::LoadU(lanes, sums + lane);
    for (std::size_t d = 0; d < dimensions; ++d) {
      const auto difference =
          hn::Sub(hn::Set(lanes, query[d]), hn::LoadU(lanes, rows + d * kLanes + lane));
      sum = hn::Add(sum, hn::Mul(difference, difference));
    }
    hn::StoreU(sum, lanes, sums + lane);
    within = within || !hn::AllFalse(lanes, hn::Le(sum, hn::Set(lanes, bound)));
  }
  return within;
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(add_squares);

bool add_squares(const float* query, const float* rows, std::size_t dimensions, float bound,
                 float* sums) {
  return HWY_DYNAMIC_DISPATCH(add_squares)(query, rows, dimensions, bound, sums);
}

}  // namespace crowdface
#endif
