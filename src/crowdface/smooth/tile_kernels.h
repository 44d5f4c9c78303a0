// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "crowdface/smooth/tiles.h"

namespace crowdface {

/// The three values of a vector field at one vertex (usually coordinates), padded by an unused
/// value so that rows fill vector registers.
template <class T>
struct alignas(4 * sizeof(T)) Row {
  T value[4];
};

/// An array of rows with uninitialised memory, so that each memory page is first written by the
/// thread that computes its rows.
template <class T>
class RowArray {
 public:
  RowArray() = default;
  explicit RowArray(std::size_t size)
      : rows_(std::make_unique_for_overwrite<Row<T>[]>(size)), size_(size) {}
  std::size_t size() const { return size_; }
  Row<T>* data() { return rows_.get(); }
  const Row<T>* data() const { return rows_.get(); }
  Row<T>& operator[](std::size_t i) { return rows_[i]; }
  const Row<T>& operator[](std::size_t i) const { return rows_[i]; }

 private:
  std::unique_ptr<Row<T>[]> rows_;
  std::size_t size_ = 0;
};

/// One step of the Chebyshev recurrence of ChebyshevFilter, in place, on the rows that the runs
/// cover: previous ← scale · (mean of the neighbours in `now`) − previous. With scale = 2, this is
/// a step from the terms k − 1 (`previous`) and k (`now`) to the term k + 1. With scale = 1 and
/// previous = 0, this is the first step, which computes the mean of the neighbours. Neighbours are
/// added in list order, so that the bits of the result do not depend on the order of computation of
/// the rows.
template <class T>
void recurrence_step(const ValenceRun* runs, std::size_t run_count, const std::uint32_t* neighbours,
                     T scale, const Row<T>* now, Row<T>* previous);

/// Computes sums[i] += factor·values[i] by fused multiply-add.
template <class T>
void add_scaled(T factor, const Row<T>* values, std::size_t count, Row<T>* sums);

/// Computes linear combinations of rows: outputs[o][i] = Σ_n factors[n·output_count +
/// o]·inputs[n][i], added in the order of n by fused multiply-add.
/// \param count  number of rows of each input and output.
void combine_rows(const Row<float>* const* inputs, std::size_t input_count, const float* factors,
                  std::size_t output_count, std::size_t count, Row<float>* const* outputs);

}  // namespace crowdface
