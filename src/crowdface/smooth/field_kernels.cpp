// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/field_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/smooth/field_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway requires foreach_target.h first, then the headers that are compiled once for each
// instruction set.
#include <algorithm>
#include <cmath>
#include <vector>

#include "crowdface/core/fused_lanes-inl.h"
#include "crowdface/smooth/field_tile.h"

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 16>;

void round_to_int16(const float* from, std::size_t count, float scale, std::int16_t* to) {
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

/// For each level, adds up the fields with descending index p, each multiplied by its level
/// function, until the sum exceeds the limit at one vertex. If this happens at field p, the tile
/// must keep the fields 0 … p. Multiplies and adds with separate rounding (no FMA), so that the
/// number of fields kept does not depend on the instruction set.
TruncationError choose_fewest_fields(const float* fields, std::size_t count, const float* functions,
                                     std::size_t stride, std::size_t levels, float most) {
  const Lanes lanes;
  const std::size_t width = hn::Lanes(lanes);
  const auto limit = hn::Set(lanes, most);
  HWY_ALIGN float left[3 * kTileVertices];
  // worst[p]: the largest error if the tile keeps p fields
  std::vector<TruncationError> worst(count + 1);
  std::size_t kept = 0;
  for (std::size_t level = 0; level < levels; ++level, functions += stride) {
    std::fill_n(left, 3 * kTileVertices, 0.0F);
    for (std::size_t p = count; p-- > kept;) {
      const auto function = hn::Set(lanes, functions[p]);
      const float* field = fields + p * 3 * kTileVertices;
      auto largest = hn::Zero(lanes);
      for (std::size_t i = 0; i < kTileVertices; i += width) {
        auto squared = hn::Zero(lanes);
        for (std::size_t c = 0; c < 3; ++c) {
          float* to = left + c * kTileVertices + i;
          const auto value = hn::LoadU(lanes, field + c * kTileVertices + i);
          const auto sum = hn::Add(hn::Load(lanes, to), hn::Mul(function, value));
          hn::Store(sum, lanes, to);
          squared = hn::Add(squared, hn::Mul(sum, sum));
        }
        largest = hn::Max(largest, squared);
      }
      if (!hn::AllFalse(lanes, hn::Gt(largest, limit))) {
        kept = p + 1;
        break;
      }
      const float here = hn::GetLane(hn::MaxOfLanes(lanes, largest));
      if (here > worst[p].squared_error) worst[p] = {0, here, level};
    }
  }
  worst[kept].kept_fields = kept;
  return worst[kept];
}

void row_products(const float* columns, std::size_t count, std::size_t row, double* products) {
  const hn::CappedTag<double, 8> lanes;
  const hn::Rebind<float, decltype(lanes)> narrow_lanes;
  using V = hn::VFromD<decltype(lanes)>;
  const std::size_t width = hn::Lanes(lanes);
  constexpr std::size_t kSums = 8;  // independent sums, to hide the latency of additions
  for (std::size_t begin = 0; begin < kPatchVertices; begin += kSums * width) {
    V sums[kSums];
    for (V& sum : sums) sum = hn::Zero(lanes);
    for (std::size_t c = 0; c < count; ++c) {
      const float* column = columns + c * kPatchVertices;
      const V factor = hn::Set(lanes, static_cast<double>(column[row]));
      for (std::size_t s = 0; s < kSums; ++s) {
        const V value = hn::PromoteTo(lanes, hn::LoadU(narrow_lanes, column + begin + s * width));
        sums[s] = fused_multiply_add(factor, value, sums[s]);
      }
    }
    for (std::size_t s = 0; s < kSums; ++s) {
      hn::StoreU(sums[s], lanes, products + begin + s * width);
    }
  }
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(round_to_int16);
HWY_EXPORT(choose_fewest_fields);
HWY_EXPORT(row_products);

void round_to_int16(const float* from, std::size_t count, float scale, std::int16_t* to) {
  HWY_DYNAMIC_DISPATCH(round_to_int16)(from, count, scale, to);
}

TruncationError choose_fewest_fields(const float* fields, std::size_t count, const float* functions,
                                     std::size_t stride, std::size_t levels, float most) {
  return HWY_DYNAMIC_DISPATCH(choose_fewest_fields)(fields, count, functions, stride, levels, most);
}

void row_products(const float* columns, std::size_t count, std::size_t row, double* products) {
  HWY_DYNAMIC_DISPATCH(row_products)(columns, count, row, products);
}

}  // namespace crowdface
#endif
