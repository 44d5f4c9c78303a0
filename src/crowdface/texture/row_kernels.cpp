// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/row_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/texture/row_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway requires foreach_target.h first, then the headers that are compiled once per target.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kRowSlack>;

void write_ramps(const Ramp* ramps, std::size_t fields, std::size_t count, float* const* rows) {
  const Lanes lanes;
  const std::size_t width = hn::Lanes(lanes);
  const auto numbers = hn::Iota(lanes, 0);
  for (std::size_t f = 0; f < fields; ++f) {
    const auto first = hn::Set(lanes, ramps[f].first), step = hn::Set(lanes, ramps[f].step);
    for (std::size_t i = 0; i < count; i += width) {
      const auto at = hn::Add(numbers, hn::Set(lanes, static_cast<float>(i)));
      hn::StoreU(hn::Add(first, hn::Mul(at, step)), lanes, rows[f] + i);
    }
  }
}

/// Loads 16-bit numbers and converts them to floats.
template <class D>
HWY_INLINE hn::Vec<D> floats_of(D lanes, const std::uint16_t* stored) {
  const hn::Rebind<std::uint16_t, D> words;
  const hn::Rebind<std::int32_t, D> integers;
  return hn::ConvertTo(lanes, hn::PromoteTo(integers, hn::LoadU(words, stored)));
}

template <std::size_t kChannels>
HWY_INLINE void add_products_of(const HeadTextureRow* heads, std::size_t count, std::size_t begin,
                                std::size_t end, float* const* sums) {
  const Lanes lanes;
  const std::size_t width = hn::Lanes(lanes);
  std::size_t x = begin;
  for (; x + width <= end; x += width) {
    auto first = hn::LoadU(lanes, sums[0] + x);
    auto second = kChannels > 1 ? hn::LoadU(lanes, sums[kChannels > 1 ? 1 : 0] + x) : first;
    auto third = kChannels > 2 ? hn::LoadU(lanes, sums[kChannels > 2 ? 2 : 0] + x) : first;
    for (std::size_t h = 0; h < count; ++h) {
      const auto factor = hn::LoadU(lanes, heads[h].factors + x);
      const auto product = [&](std::size_t c) {
        return hn::Mul(factor, floats_of(lanes, heads[h].stored[c] + x));
      };
      first = hn::Add(first, product(0));
      if (kChannels > 1) second = hn::Add(second, product(1));
      if (kChannels > 2) third = hn::Add(third, product(2));
    }
    hn::StoreU(first, lanes, sums[0] + x);
    if (kChannels > 1) hn::StoreU(second, lanes, sums[1] + x);
    if (kChannels > 2) hn::StoreU(third, lanes, sums[2] + x);
  }
  for (; x < end; ++x) {
    for (std::size_t c = 0; c < kChannels; ++c) {
      for (std::size_t h = 0; h < count; ++h) {
        sums[c][x] += heads[h].factors[x] * static_cast<float>(heads[h].stored[c][x]);
      }
    }
  }
}

void add_products(const HeadTextureRow* heads, std::size_t count, std::size_t begin,
                  std::size_t end, float* const* sums, std::size_t channels) {
  if (channels == 1) add_products_of<1>(heads, count, begin, end, sums);
  if (channels == 2) add_products_of<2>(heads, count, begin, end, sums);
  if (channels == 3) add_products_of<3>(heads, count, begin, end, sums);
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(write_ramps);
HWY_EXPORT(add_products);

void write_ramps(std::span<const Ramp> ramps, std::size_t count, float* const* rows) {
  HWY_DYNAMIC_DISPATCH(write_ramps)(ramps.data(), ramps.size(), count, rows);
}

void add_products(std::span<const HeadTextureRow> heads, std::size_t begin, std::size_t end,
                  std::span<float* const> sums) {
  HWY_DYNAMIC_DISPATCH(add_products)
  (heads.data(), heads.size(), begin, end, sums.data(), sums.size());
}

}  // namespace crowdface
#endif
