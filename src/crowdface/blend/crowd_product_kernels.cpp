// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/crowd_product_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/blend/crowd_product_kernels.cpp"
#include "hwy/foreach_target.h"
// Highway requires foreach_target.h first, then the headers that are compiled once for each
// instruction set.
#include <algorithm>

#include "crowdface/core/fused_lanes-inl.h"
#include "crowdface/smooth/field_tile.h"

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

void dequantize(const std::int16_t* numbers, std::size_t count, float step, float* values) {
  const hn::CappedTag<float, kPatchPadding> lanes;
  const auto factor = hn::Set(lanes, step);
  for (std::size_t i = 0; i < count; i += hn::Lanes(lanes)) {
    hn::StoreU(hn::Mul(widened(lanes, numbers + i), factor), lanes, values + i);
  }
}

template <class Lanes>
HWY_INLINE hn::VFromD<Lanes> numbers_at(Lanes lanes, const std::int16_t* numbers) {
  return widened(lanes, numbers);
}
template <class Lanes>
HWY_INLINE hn::VFromD<Lanes> numbers_at(Lanes lanes, const float* values) {
  return hn::LoadU(lanes, values);
}

/// Computes, for kColumns columns, the elements of each product that fill kRegisters SIMD
/// registers, beginning at element `begin`. All sums stay in registers.
///
/// \param alpha  If null, the products are stored in `products`. Otherwise alpha·product is added
///               to `products`.
template <std::size_t kColumns, std::size_t kRegisters, class Number>
HWY_INLINE void multiply_some(const MatrixRows<Number>& rows, const float* const* columns,
                              const float* alpha, std::size_t begin, float* const* products) {
  const hn::CappedTag<float, kPatchPadding> lanes;
  using V = hn::VFromD<decltype(lanes)>;
  const std::size_t width = hn::Lanes(lanes);
  V sums[kColumns][kRegisters];
  for (auto& of_column : sums) {
    for (V& sum : of_column) sum = hn::Zero(lanes);
  }
  for (const std::uint32_t row : rows.used_rows) {
    const Number* numbers = rows.values + row * rows.stride + begin;
    V values[kRegisters];
    for (std::size_t v = 0; v < kRegisters; ++v) values[v] = numbers_at(lanes, numbers + v * width);
    for (std::size_t c = 0; c < kColumns; ++c) {
      const V factor = hn::Set(lanes, columns[c][row]);
      for (std::size_t v = 0; v < kRegisters; ++v) {
        sums[c][v] = fused_multiply_add(factor, values[v], sums[c][v]);
      }
    }
  }
  for (std::size_t c = 0; c < kColumns; ++c) {
    for (std::size_t v = 0; v < kRegisters; ++v) {
      float* to = products[c] + begin + v * width;
      if (alpha == nullptr) {
        hn::StoreU(sums[c][v], lanes, to);
      } else {
        const V share = hn::LoadU(lanes, alpha + begin + v * width);
        hn::StoreU(hn::Add(hn::LoadU(lanes, to), hn::Mul(share, sums[c][v])), lanes, to);
      }
    }
  }
}

template <std::size_t kColumns, class Number>
void multiply_columns(const MatrixRows<Number>& rows, const float* const* columns,
                      const float* alpha, float* const* products) {
  const hn::CappedTag<float, kPatchPadding> lanes;
  const std::size_t width = hn::Lanes(lanes);
  constexpr std::size_t kMany = kColumns <= 2 ? 6 : kColumns <= 3 ? 4 : 2;
  std::size_t i = 0;
  for (; i + kMany * width <= rows.width; i += kMany * width) {
    multiply_some<kColumns, kMany>(rows, columns, alpha, i, products);
  }
  for (; i + 2 * width <= rows.width; i += 2 * width) {
    multiply_some<kColumns, 2>(rows, columns, alpha, i, products);
  }
  for (; i < rows.width; i += width) {
    multiply_some<kColumns, 1>(rows, columns, alpha, i, products);
  }
}

template <class Number>
void multiply_any(const MatrixRows<Number>& rows, const float* const* columns, std::size_t count,
                  const float* alpha, float* const* products) {
  using Multiply =
      void (*)(const MatrixRows<Number>&, const float* const*, const float*, float* const*);
  constexpr Multiply kMultiply[kMaxColumns] = {
      multiply_columns<1, Number>, multiply_columns<2, Number>, multiply_columns<3, Number>,
      multiply_columns<4, Number>, multiply_columns<5, Number>, multiply_columns<6, Number>};
  kMultiply[count - 1](rows, columns, alpha, products);
}

// Highway's dispatch table needs non-template functions.
void multiply_floats(const MatrixRows<float>& rows, const float* const* columns, std::size_t count,
                     const float* alpha, float* const* products) {
  multiply_any(rows, columns, count, alpha, products);
}
void multiply_numbers(const MatrixRows<std::int16_t>& rows, const float* const* columns,
                      std::size_t count, const float* alpha, float* const* products) {
  multiply_any(rows, columns, count, alpha, products);
}

/// Writes one run of vertices. Whole cache lines are written with streaming stores, the partial
/// lines at both ends with ordinary stores.
void write_run(const double* base, const float* added, std::size_t count, double* results) {
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

void write_sums(std::span<const VertexRun> runs, const double* base, const float* added,
                double* results) {
  const hn::CappedTag<float, kPatchPadding> lanes;
  HWY_ALIGN float by_vertex[3 * kPatchVertices];
  for (std::size_t i = 0; i < kPatchVertices; i += hn::Lanes(lanes)) {
    const float* x = added + i;
    hn::StoreInterleaved3(hn::LoadU(lanes, x), hn::LoadU(lanes, x + kPatchVertices),
                          hn::LoadU(lanes, x + 2 * kPatchVertices), lanes, by_vertex + 3 * i);
  }
  const float* more = by_vertex;
  for (const VertexRun& run : runs) {
    const std::size_t at = std::size_t{3} * run.first, count = std::size_t{3} * run.count;
    write_run(base + at, more, count, results + at);
    more += count;
  }
}

void wait_for_streaming_stores() {
  hwy::FlushStream();
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(dequantize);
HWY_EXPORT(multiply_floats);
HWY_EXPORT(multiply_numbers);
HWY_EXPORT(write_sums);
HWY_EXPORT(wait_for_streaming_stores);

void dequantize(const std::int16_t* numbers, std::size_t count, float step, float* values) {
  HWY_DYNAMIC_DISPATCH(dequantize)(numbers, count, step, values);
}

void multiply(const MatrixRows<float>& rows, std::span<const float* const> columns,
              std::span<float* const> products) {
  HWY_DYNAMIC_DISPATCH(multiply_floats)
  (rows, columns.data(), columns.size(), nullptr, products.data());
}

void multiply(const MatrixRows<std::int16_t>& rows, std::span<const float* const> columns,
              std::span<float* const> products) {
  HWY_DYNAMIC_DISPATCH(multiply_numbers)
  (rows, columns.data(), columns.size(), nullptr, products.data());
}

void add_product(const MatrixRows<float>& rows, std::span<const float* const> columns,
                 const float* alpha, std::span<float* const> sums) {
  HWY_DYNAMIC_DISPATCH(multiply_floats)(rows, columns.data(), columns.size(), alpha, sums.data());
}

void write_sums(std::span<const VertexRun> runs, const double* base, const float* added,
                double* results) {
  HWY_DYNAMIC_DISPATCH(write_sums)(runs, base, added, results);
}

void wait_for_streaming_stores() {
  HWY_DYNAMIC_DISPATCH(wait_for_streaming_stores)();
}

}  // namespace crowdface
#endif
