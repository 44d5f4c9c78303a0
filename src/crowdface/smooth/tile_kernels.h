// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "crowdface/smooth/tiles.h"

namespace crowdface {

/// x, y, z and a zero: what the vector instructions take at a time.
template <class T>
struct alignas(4 * sizeof(T)) Row {
  T value[4];
};

/// Rows whose memory is not initialised, so that the threads that compute them are the first to touch
/// it.
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

/// One step of the recurrence on the rows of the runs, in place:
/// previous ← scale·(mean of the neighbours in now) − previous. With scale 2 that is
/// T_{k+1}(W) x = 2 W T_k(W) x − T_{k−1}(W) x; with scale 1 and previous = 0 the first step W x.
/// Neighbours are added in their order, so that the bits depend on nothing but the values.
template <class T>
void recurrence_step(const ValenceRun* runs, std::size_t run_count, const std::uint32_t* rings,
                     T scale, const Row<T>* now, Row<T>* previous);

/// sums[i] += factor·values[i], each with one rounding.
template <class T>
void add_scaled(T factor, const Row<T>* values, std::size_t count, Row<T>* sums);

/// Linear combinations, row by row: outputs[o][i] = Σ_n factors[n·output_count + o]·inputs[n][i],
/// added in the order of n, each term with one rounding.
void combine_rows(const Row<float>* const* inputs, std::size_t input_count, const float* factors,
                  std::size_t output_count, std::size_t count, Row<float>* const* outputs);

}  // namespace crowdface
