// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace crowdface {

/// Largest number of columns in one matrix product. The sums of six columns, two SIMD vectors for
/// each column, just fit into the vector registers.
inline constexpr std::size_t kMaxColumns = 6;

/// Converts quantized numbers to floats: values[i] = numbers[i]·step.
///
/// \param count  a multiple of kPatchPadding.
void dequantize(const std::int16_t* numbers, std::size_t count, float step, float* values);

/// The matrix whose rows `multiply` adds up. The values are quantized (int16) or unpacked (float).
template <class Number>
struct MatrixRows {
  const Number* values;  ///< first element of the first row
  /// distance from the start of one row to the start of the next row, in elements
  std::size_t stride;
  std::size_t width;  ///< number of elements in a row; a multiple of kPatchPadding
  /// indices of the rows that are added up, in this order
  std::span<const std::uint32_t> used_rows;
};

/// Computes products[c][i] = Σ_r columns[c][r]·values[r·stride + i] by fused multiply-add. The sum
/// is over the used rows r.
///
/// \param columns, products  1 to kMaxColumns; as many columns as products.
void multiply(const MatrixRows<float>& rows, std::span<const float* const> columns,
              std::span<float* const> products);
/// Computes the same products as `multiply` for floats, but from the quantized values of the rows.
void multiply(const MatrixRows<std::int16_t>& rows, std::span<const float* const> columns,
              std::span<float* const> products);

/// Computes sums[c][i] += alpha[i]·products[c][i], where `products` are the results of `multiply`.
void add_product(const MatrixRows<float>& rows, std::span<const float* const> columns,
                 const float* alpha, std::span<float* const> sums);

/// A range of vertices of the mesh with consecutive numbers.
struct VertexRun {
  std::uint32_t first = 0;  ///< index of the run's first vertex
  std::uint32_t count = 0;  ///< number of vertices in the run
};

/// Writes results = base + added at the vertices of the runs. Uses streaming stores, which bypass
/// the caches: a crowd's faces are far larger than the caches, and an ordinary store would first
/// read the cache line that it overwrites. Before another thread may read the results, the writing
/// thread must call wait_for_streaming_stores().
///
/// \param base, results  #V by 3; may be the same array.
/// \param added          3 by kPatchVertices: x of all vertices of the runs, then y, then z.
void write_sums(std::span<const VertexRun> runs, const double* base, const float* added,
                double* results);
/// Waits until the streaming stores of the calling thread are complete.
void wait_for_streaming_stores();

}  // namespace crowdface
