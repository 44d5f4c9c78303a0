// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace crowdface {

/// Columns that a product is made with at a time: with two vectors of values, what a processor's vector registers hold.
inline constexpr std::size_t kColumns = 6;

/// Whole numbers times a step.
void unpack(const std::int16_t* numbers, std::size_t count, float step, float* values);

/// Rows of numbers, as they are kept or as `unpack` makes them.
template <class Number>
struct ProductRows {
  const Number* values;
  std::size_t stride;                   ///< from row to row
  std::size_t width;                    ///< of a row; a multiple of kPatchStep
  std::span<const std::uint32_t> used;  ///< rows that are added up, in this order
};

/// products[c][i] = Σ_r columns[c][r]·values[r·stride + i] over the used rows, each term with one rounding.
/// \param columns, products  up to kColumns
void multiply(const ProductRows<float>& rows, std::span<const float* const> columns,
              std::span<float* const> products);
void multiply(const ProductRows<std::int16_t>& rows, std::span<const float* const> columns,
              std::span<float* const> products);

/// sums[c][i] += alpha[i]·(the same product).
void add_product(const ProductRows<float>& rows, std::span<const float* const> columns,
                 const float* alpha, std::span<float* const> sums);

/// Vertices that follow each other in the mesh.
struct VertexRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// results = base + added at the vertices of the runs, written past the caches: a crowd's faces are
/// far larger, and a cached store would read from memory what it is about to overwrite.
/// finish_writing() must follow on the same thread before another may read them.
/// \param base, results  #V by 3; may be the same
/// \param added          3 by kPatchVertices: x of all runs' vertices, y, z
void write_sums(std::span<const VertexRun> runs, const double* base, const float* added,
                double* results);
void finish_writing();

}  // namespace crowdface
