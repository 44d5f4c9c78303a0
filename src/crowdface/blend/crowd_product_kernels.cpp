// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/crowd_product_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/blend/crowd_product_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway's order of includes: foreach_target.h first, then what is compiled once for each target.
#include <algorithm>
#include <cmath>

#include "crowdface/core/fused_lanes-inl.h"

#include "hwy/cache_control.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Lanes>
HWY_INLINE hn::VFromD<Lanes> widened(Lanes lanes, const std::int16_t* numbers) {
  const hn::Rebind<std::int32_t, Lanes> whole;
  const hn::Rebind<std::int16_t, Lanes> narrow;
  return hn::ConvertTo(lanes, hn::PromoteTo(whole, hn::LoadU(narrow, numbers)));
}

void unpack(const std::int16_t* numbers, std::size_t count, float step, std::size_t in_row,
            float* row, std::size_t stride) {
  const hn::CappedTag<float, kChunkValues / 2> lanes;
  const std::size_t width = hn::Lanes(lanes);
  const auto factor = hn::Set(lanes, step);
  while (count > 0) {
    const std::size_t here = std::min(kChunkValues - in_row, count);
    std::size_t i = 0;
    for (; i < here && i + width <= count; i += width) {
      hn::StoreU(hn::Mul(widened(lanes, numbers + i), factor), lanes, row + in_row + i);
    }
    for (; i < here; ++i) row[in_row + i] = static_cast<float>(numbers[i]) * step;
    numbers += here;
    count -= here;
    row += stride;
    in_row = 0;
  }
}

/// The sums of six vectors in kRegions regions stay in registers.
constexpr std::size_t kVectors = 6;
template <std::size_t kRegions>
void add_vectors(const std::int16_t* numbers, std::size_t fields, const RegionSums* regions,
                 std::size_t begin, const std::int16_t* ahead) {
  const hn::CappedTag<float, kChunkValues / 2> lanes;
  const std::size_t width = hn::Lanes(lanes);
  using V = hn::VFromD<decltype(lanes)>;
  // Lines of the cache that begin among these numbers.
  constexpr std::size_t kLineNumbers = 64 / sizeof(std::int16_t);
  const std::size_t first_line = (begin + kLineNumbers - 1) / kLineNumbers * kLineNumbers;
  numbers += begin;
  V sums[kRegions][kVectors];
  for (std::size_t k = 0; k < kRegions; ++k) {
    for (std::size_t v = 0; v < kVectors; ++v) {
      sums[k][v] = hn::Load(lanes, regions[k].sums + begin + v * width);
    }
  }
  for (std::size_t f = 0; f < fields; ++f, numbers += kTileValues, ahead += kTileValues) {
    for (std::size_t i = first_line; i < begin + kVectors * width; i += kLineNumbers) {
      hwy::Prefetch(ahead + i);
    }
    V factors[kRegions];
    for (std::size_t k = 0; k < kRegions; ++k) {
      factors[k] = hn::Set(lanes, regions[k].coefficients[f]);
    }
    for (std::size_t v = 0; v < kVectors; ++v) {
      const V values = widened(lanes, numbers + v * width);
      for (std::size_t k = 0; k < kRegions; ++k) {
        sums[k][v] = fused(factors[k], values, sums[k][v]);
      }
    }
  }
  for (std::size_t k = 0; k < kRegions; ++k) {
    for (std::size_t v = 0; v < kVectors; ++v) {
      hn::Store(sums[k][v], lanes, regions[k].sums + begin + v * width);
    }
  }
}

template <std::size_t kRegions>
void add_in_regions(const std::int16_t* numbers, std::size_t fields, const RegionSums* regions,
                    std::size_t begin, std::size_t end, const std::int16_t* ahead) {
  const hn::CappedTag<float, kChunkValues / 2> lanes;
  static_assert(kTileValues % (kVectors * hn::MaxLanes(lanes)) == 0);
  // A vector alone would wait for each addition before it: whole sixes at both ends, too.
  const std::size_t step = kVectors * hn::Lanes(lanes);
  for (std::size_t i = begin / step * step; i < end; i += step) {
    add_vectors<kRegions>(numbers, fields, regions, i, ahead);
  }
}

void add_fields(const std::int16_t* numbers, std::size_t fields, const RegionSums* regions,
                std::size_t region_count, std::size_t begin, std::size_t end,
                const std::int16_t* ahead) {
  const auto add = region_count == 1 ? add_in_regions<1> : add_in_regions<2>;
  add(numbers, fields, regions, begin, end, ahead);
}

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
    for (std::size_t f = 0; f < count; ++f) {
      const float* factor = coefficients + fields[f] * kChunkFaces;
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

HWY_EXPORT(unpack);
HWY_EXPORT(add_fields);
HWY_EXPORT(add_product);
HWY_EXPORT(write_sums);
HWY_EXPORT(finish_writing);

void unpack(const std::int16_t* numbers, std::size_t count, float step, std::size_t in_row,
            float* row, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(unpack)(numbers, count, step, in_row, row, stride);
}

void add_fields(const std::int16_t* numbers, std::size_t fields,
                std::span<const RegionSums> regions, std::size_t begin, std::size_t end,
                const std::int16_t* ahead) {
  HWY_DYNAMIC_DISPATCH(add_fields)
  (numbers, fields, regions.data(), regions.size(), begin, end, ahead);
}

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
