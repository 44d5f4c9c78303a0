// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/row_kernels.h"

#include <algorithm>
#include <cmath>

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

void write_unit_normals(const float* u, const float* v, std::size_t count, std::uint16_t* out,
                        std::uint64_t* sums) {
  const Lanes lanes;
  const hn::Rebind<std::int32_t, Lanes> integers;
  const hn::Rebind<std::uint16_t, Lanes> words;
  const std::size_t width = hn::Lanes(lanes);
  const auto one = hn::Set(lanes, 1.0F), half = hn::Set(lanes, 0.5F);
  const auto most = hn::Set(lanes, 65535.0F);
  const auto encoded = [&](hn::Vec<Lanes> component) HWY_ATTR {
    const auto share = hn::Mul(hn::Add(component, one), half);
    const auto scaled = hn::Add(hn::Mul(most, share), half);
    return hn::ConvertTo(integers, hn::Min(hn::Max(scaled, hn::Zero(lanes)), most));
  };
  auto first = hn::Zero(integers), second = first, third = first;
  std::size_t x = 0;
  for (; x + width <= count; x += width) {
    const auto along_u = hn::LoadU(lanes, u + x), along_v = hn::LoadU(lanes, v + x);
    const auto square = hn::Add(hn::Mul(along_u, along_u), hn::Add(hn::Mul(along_v, along_v), one));
    const auto length = hn::Sqrt(square);
    const auto a = encoded(hn::Div(along_u, length)), b = encoded(hn::Div(along_v, length)),
               c = encoded(hn::Div(one, length));
    first = hn::Add(first, a);
    second = hn::Add(second, b);
    third = hn::Add(third, c);
    hn::StoreInterleaved3(hn::DemoteTo(words, a), hn::DemoteTo(words, b), hn::DemoteTo(words, c),
                          words, out + 3 * x);
  }
  std::int32_t of_lanes[3][kRowSlack];
  hn::StoreU(first, integers, of_lanes[0]);
  hn::StoreU(second, integers, of_lanes[1]);
  hn::StoreU(third, integers, of_lanes[2]);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < width; ++i) sums[c] += static_cast<std::uint64_t>(of_lanes[c][i]);
  }
  for (; x < count; ++x) {
    const float length = std::sqrt(u[x] * u[x] + (v[x] * v[x] + 1));
    const float normal[3] = {u[x] / length, v[x] / length, 1 / length};
    for (std::size_t c = 0; c < 3; ++c) {
      const float scaled = 65535 * ((normal[c] + 1) / 2) + 0.5F;
      sums[c] += out[3 * x + c] = static_cast<std::uint16_t>(std::clamp(scaled, 0.0F, 65535.0F));
    }
  }
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(write_ramps);
HWY_EXPORT(add_products);
HWY_EXPORT(write_unit_normals);

void write_ramps(std::span<const Ramp> ramps, std::size_t count, float* const* rows) {
  HWY_DYNAMIC_DISPATCH(write_ramps)(ramps.data(), ramps.size(), count, rows);
}

void add_products(std::span<const HeadTextureRow> heads, std::size_t begin, std::size_t end,
                  std::span<float* const> sums) {
  HWY_DYNAMIC_DISPATCH(add_products)
  (heads.data(), heads.size(), begin, end, sums.data(), sums.size());
}

std::array<std::uint64_t, 3> write_unit_normals(std::array<const float*, 2> slopes,
                                                std::size_t count, std::uint16_t* out) {
  std::array<std::uint64_t, 3> sums = {};
  HWY_DYNAMIC_DISPATCH(write_unit_normals)(slopes[0], slopes[1], count, out, sums.data());
  return sums;
}

}  // namespace crowdface
#endif
