// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/row_kernels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/texture/row_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway requires foreach_target.h first, then the headers that are compiled once for each
// instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kRowSlack>;

/// Loads 16-bit numbers and converts them to floats.
template <class D>
HWY_INLINE hn::Vec<D> floats_of(D lanes, const std::uint16_t* stored) {
  const hn::Rebind<std::uint16_t, D> words;
  const hn::Rebind<std::int32_t, D> integers;
  return hn::ConvertTo(lanes, hn::PromoteTo(integers, hn::LoadU(words, stored)));
}

/// Writes the value of each field at the first texel, and its increase from texel to texel.
void write_ramps(const InterpolatedFields& fields, float* first, float* step) {
  const Lanes lanes;
  const auto [b, c] = fields.barycentrics;
  const auto [b_step, c_step] = fields.barycentric_steps;
  for (std::size_t f = 0; f < fields.count; f += hn::Lanes(lanes)) {
    const auto corner = hn::LoadU(lanes, fields.corners[0] + f);
    const auto to_second = hn::Sub(hn::LoadU(lanes, fields.corners[1] + f), corner);
    const auto to_third = hn::Sub(hn::LoadU(lanes, fields.corners[2] + f), corner);
    const auto weighted = [&](float second, float third) HWY_ATTR {
      return std::pair(hn::Mul(hn::Set(lanes, second), to_second),
                       hn::Mul(hn::Set(lanes, third), to_third));
    };
    const auto [second, third] = weighted(b, c);
    hn::StoreU(hn::Add(hn::Add(corner, second), third), lanes, first + f);
    const auto [second_step, third_step] = weighted(b_step, c_step);
    hn::StoreU(hn::Add(second_step, third_step), lanes, step + f);
  }
}

template <std::size_t kChannels>
HWY_INLINE void blend_channels(const float* first, const float* step, const StoredRow* heads,
                               std::size_t head_count, std::size_t begin, std::size_t end,
                               std::size_t readable, float* const* sums) {
  const Lanes lanes;
  const std::size_t width = hn::Lanes(lanes);
  const auto numbers = hn::Iota(lanes, 0);
  std::size_t x = begin;
  for (; x < end && x + width <= readable; x += width) {
    const auto at = hn::Add(numbers, hn::Set(lanes, static_cast<float>(x - begin)));
    const auto field = [&](std::size_t f) HWY_ATTR {
      return hn::Add(hn::Set(lanes, first[f]), hn::Mul(at, hn::Set(lanes, step[f])));
    };
    auto red = field(0), green = kChannels > 1 ? field(1) : red;
    auto blue = kChannels > 2 ? field(2) : red;
    for (std::size_t h = 0; h < head_count; ++h) {
      const auto factor = field(kChannels + h);
      const auto product = [&](std::size_t c) HWY_ATTR {
        return hn::Mul(factor, floats_of(lanes, heads[h][c] + x));
      };
      red = hn::Add(red, product(0));
      if (kChannels > 1) green = hn::Add(green, product(1));
      if (kChannels > 2) blue = hn::Add(blue, product(2));
    }
    hn::StoreU(red, lanes, sums[0] + x);
    if (kChannels > 1) hn::StoreU(green, lanes, sums[1] + x);
    if (kChannels > 2) hn::StoreU(blue, lanes, sums[2] + x);
  }
  for (; x < end; ++x) {
    const auto at = static_cast<float>(x - begin);
    for (std::size_t c = 0; c < kChannels; ++c) {
      sums[c][x] = first[c] + at * step[c];
      for (std::size_t h = 0; h < head_count; ++h) {
        const float factor = first[kChannels + h] + at * step[kChannels + h];
        sums[c][x] += factor * static_cast<float>(heads[h][c][x]);
      }
    }
  }
}

void blend_texels(const InterpolatedFields& fields, const StoredRow* heads, std::size_t head_count,
                  std::size_t begin, std::size_t end, std::size_t readable, float* ramps,
                  float* const* sums, std::size_t channels) {
  float* const step = ramps + fields.count + kRowSlack;
  write_ramps(fields, ramps, step);
  const auto blend = channels == 1   ? blend_channels<1>
                     : channels == 2 ? blend_channels<2>
                                     : blend_channels<3>;
  blend(ramps, step, heads, head_count, begin, end, readable, sums);
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

HWY_EXPORT(blend_texels);
HWY_EXPORT(write_unit_normals);

void blend_texels(const InterpolatedFields& fields, std::span<const StoredRow> heads,
                  std::size_t begin, std::size_t end, std::size_t readable, std::span<float> ramps,
                  std::span<float* const> sums) {
  HWY_DYNAMIC_DISPATCH(blend_texels)
  (fields, heads.data(), heads.size(), begin, end, readable, ramps.data(), sums.data(),
   sums.size());
}

std::array<std::uint64_t, 3> write_unit_normals(std::array<const float*, 2> slopes,
                                                std::size_t count, std::uint16_t* out) {
  std::array<std::uint64_t, 3> sums = {};
  HWY_DYNAMIC_DISPATCH(write_unit_normals)(slopes[0], slopes[1], count, out, sums.data());
  return sums;
}

}  // namespace crowdface
#endif
