// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace crowdface {

/// Largest number of columns in a matrix product. The sums for six columns and two vectors of
/// values just fit into the vector registers.
inline constexpr std::size_t kMaxColumns = 6;

/// Converts quantized numbers to values: values[i] = numbers[i]·step.
/// \param count  a multiple of kPatchPadding.
void unpack(const std::int16_t* numbers, std::size_t count, float step, float* values);

/// The left matrix of a product: rows of quantized (int16) or unpacked (float) values.
template <class Number>
struct ProductRows {
  const Number* values;
  std::size_t stride;  ///< distance between the starts of consecutive rows, in elements
  std::size_t width;   ///< elements per row; a multiple of kPatchPadding
  std::span<const std::uint32_t>
      used_rows;  ///< indices of the rows that enter the sum, in this order
};

/// products[c][i] = Σ_r columns[c][r]·values[r·stride + i] over the used rows, by fused
/// multiply-add.
/// \param columns, products  the same number of both, 1 to kMaxColumns.
void multiply(const ProductRows<float>& rows, std::span<const float* const> columns,
              std::span<float* const> products);
void multiply(const ProductRows<std::int16_t>& rows, std::span<const float* const> columns,
              std::span<float* const> products);

/// sums[c][i] += alpha[i]·products[c][i], with the products of `multiply`.
void add_product(const ProductRows<float>& rows, std::span<const float* const> columns,
                 const float* alpha, std::span<float* const> sums);

/// A range of consecutive vertices of the mesh.
struct VertexRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Writes results = base + added at the vertices of the runs. Uses streaming stores, which bypass
/// the caches. A crowd's faces are far larger than the caches, and a cached store would first read
/// the line that it overwrites. Before another thread may read the results, the writing thread must
/// call finish_writing().
/// \param base, results  #V by 3; may be the same array.
/// \param added          3 by kPatchVertices: x of all vertices of the runs, then y, then z.
void write_sums(std::span<const VertexRun> runs, const double* base, const float* added,
                double* results);
/// Completes the streaming stores of the calling thread.
void finish_writing();

}  // namespace crowdface
