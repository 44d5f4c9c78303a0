// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/float_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/cast/float_kernels.cpp"
#include "hwy/foreach_target.h"
// The SIMD library Highway needs this order: foreach_target.h first, then the code that is compiled
// once for each instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 16>;

constexpr std::size_t kSums = 16, kChunk = 64 * kSums;

/// Partial sums over one chunk of numbers, one sum for each lane.
template <class Numbers>
struct ChunkSums {
  static constexpr std::size_t kVectors = kSums / hn::MaxLanes(Lanes());

  const Numbers& numbers;
  /// Indices of the chunk's numbers: [begin, groups_end) are full groups of kSums numbers, and
  /// [groups_end, end) are the remaining numbers.
  std::size_t begin, end, groups_end;
  hn::VFromD<Lanes> sums[kVectors];

  ChunkSums(const Numbers& of, std::size_t from, std::size_t to)
      : numbers(of), begin(from), end(to), groups_end(to - (to - from) % kSums) {
    for (auto& sum : sums) sum = hn::Zero(Lanes());
  }
  void add(std::size_t at) {
    for (std::size_t v = 0; v < kVectors; ++v) {
      sums[v] = hn::Add(sums[v], numbers.some(at + v * hn::Lanes(Lanes())));
    }
  }
  void add_to(double& total) const {
    float parts[kSums];
    for (std::size_t v = 0; v < kVectors; ++v) {
      hn::StoreU(sums[v], Lanes(), parts + v * hn::Lanes(Lanes()));
    }
    for (std::size_t i = groups_end; i < end; ++i) parts[i - groups_end] += numbers.one(i);
    for (const float part : parts) total += static_cast<double>(part);
  }
};

template <class Numbers>
double sum_of(const Numbers& numbers, std::size_t count) {
  double total = 0;
  // Process two chunks at a time: their additions are independent, so the processor overlaps them.
  for (std::size_t begin = 0; begin < count; begin += 2 * kChunk) {
    const std::size_t middle = begin + kChunk < count ? begin + kChunk : count;
    const std::size_t end = middle + kChunk < count ? middle + kChunk : count;
    ChunkSums first(numbers, begin, middle), second(numbers, middle, end);
    std::size_t done = 0;
    for (; middle + done < second.groups_end; done += kSums) {
      first.add(begin + done);
      second.add(middle + done);
    }
    for (; begin + done < first.groups_end; done += kSums) first.add(begin + done);
    first.add_to(total);
    if (middle < end) second.add_to(total);
  }
  return total;
}

struct Products {
  const float *a, *b;

  auto some(std::size_t i) const {
    return hn::Mul(hn::LoadU(Lanes(), a + i), hn::LoadU(Lanes(), b + i));
  }
  float one(std::size_t i) const { return a[i] * b[i]; }
};

double fixed_order_dot(const float* a, const float* b, std::size_t count) {
  return sum_of(Products{a, b}, count);
}

/// The terms that add_scaled_and_sum_squares adds up: term i is (to[i] + factor·from[i])².
/// Computing term i also stores to[i] + factor·from[i] in to[i].
struct SquaresOfUpdatedNumbers {
  float factor;
  const float* from;
  float* to;

  auto some(std::size_t i) const {
    const Lanes lanes;
    const auto product = hn::Mul(hn::Set(lanes, factor), hn::LoadU(lanes, from + i));
    const auto sum = hn::Add(hn::LoadU(lanes, to + i), product);
    hn::StoreU(sum, lanes, to + i);
    return hn::Mul(sum, sum);
  }
  float one(std::size_t i) const {
    to[i] += factor * from[i];
    return to[i] * to[i];
  }
};

double add_scaled_and_sum_squares(float factor, const float* from, std::size_t count, float* to) {
  return sum_of(SquaresOfUpdatedNumbers{factor, from, to}, count);
}

void add_scaled(float factor, const float* from, std::size_t count, float* to) {
  const Lanes lanes;
  const std::size_t width = hn::Lanes(lanes);
  const auto factors = hn::Set(lanes, factor);
  std::size_t i = 0;
  for (; i + width <= count; i += width) {
    const auto product = hn::Mul(factors, hn::LoadU(lanes, from + i));
    hn::StoreU(hn::Add(hn::LoadU(lanes, to + i), product), lanes, to + i);
  }
  for (; i < count; ++i) to[i] += factor * from[i];
}

/// Computes to += Σ factors[i]·rows[i], where i takes all values in `list`. Computes only the
/// leading columns that fill kRegisters SIMD registers.
///
/// \param width  number of columns
template <std::size_t kRegisters>
void add_rows_at_columns(const float* factors, const std::size_t* list, std::size_t list_size,
                         const float* rows, std::size_t width, float* to) {
  const Lanes lanes;
  const std::size_t one = hn::Lanes(lanes);
  hn::VFromD<Lanes> sums[kRegisters];
  for (std::size_t c = 0; c < kRegisters; ++c) sums[c] = hn::LoadU(lanes, to + c * one);
  for (std::size_t n = 0; n < list_size; ++n) {
    const auto factor = hn::Set(lanes, factors[list[n]]);
    const float* row = rows + list[n] * width;
    for (std::size_t c = 0; c < kRegisters; ++c)
      sums[c] = hn::Add(sums[c], hn::Mul(factor, hn::LoadU(lanes, row + c * one)));
  }
  for (std::size_t c = 0; c < kRegisters; ++c) hn::StoreU(sums[c], lanes, to + c * one);
}

void add_product(const float* factors, std::size_t vectors, std::size_t count, const float* rows,
                 std::size_t width, float* to) {
  // Multiply in blocks of kRows rows of the matrix `rows`: add the products of one block for all
  // vectors before the next block, so that the block stays in a fast cache.
  constexpr std::size_t kRows = 128;
  const std::size_t one = hn::Lanes(Lanes());
  for (std::size_t begin = 0; begin < count; begin += kRows) {
    const std::size_t rest = count - begin, now = rest < kRows ? rest : kRows;
    const float* some = rows + begin * width;
    for (std::size_t v = 0; v < vectors; ++v) {
      const float* row_factors = factors + v * count + begin;
      std::size_t list[kRows], size = 0;  // rows whose factors are not zero
      for (std::size_t i = 0; i < now; ++i) {
        list[size] = i;
        size += row_factors[i] != 0 ? 1 : 0;
      }
      float* sums = to + v * width;
      std::size_t d = 0;
      for (; d + 8 * one <= width; d += 8 * one)
        add_rows_at_columns<8>(row_factors, list, size, some + d, width, sums + d);
      for (; d + 2 * one <= width; d += 2 * one)
        add_rows_at_columns<2>(row_factors, list, size, some + d, width, sums + d);
      for (; d + one <= width; d += one)
        add_rows_at_columns<1>(row_factors, list, size, some + d, width, sums + d);
      for (; d < width; ++d) {
        for (std::size_t n = 0; n < size; ++n)
          sums[d] += row_factors[list[n]] * some[list[n] * width + d];
      }
    }
  }
}

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

HWY_EXPORT(fixed_order_dot);
HWY_EXPORT(add_scaled);
HWY_EXPORT(add_scaled_and_sum_squares);
HWY_EXPORT(add_product);
HWY_EXPORT(add_squares);

double fixed_order_dot(const float* a, const float* b, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(fixed_order_dot)(a, b, count);
}

void add_scaled(float factor, const float* from, std::size_t count, float* to) {
  HWY_DYNAMIC_DISPATCH(add_scaled)(factor, from, count, to);
}

double add_scaled_and_sum_squares(float factor, const float* from, std::size_t count, float* to) {
  return HWY_DYNAMIC_DISPATCH(add_scaled_and_sum_squares)(factor, from, count, to);
}

void add_product(const float* factors, std::size_t vectors, std::size_t count, const float* rows,
                 std::size_t width, float* to) {
  HWY_DYNAMIC_DISPATCH(add_product)(factors, vectors, count, rows, width, to);
}

bool add_squares(const float* query, const float* rows, std::size_t dimensions, float bound,
                 float* sums) {
  return HWY_DYNAMIC_DISPATCH(add_squares)(query, rows, dimensions, bound, sums);
}

}  // namespace crowdface
#endif
