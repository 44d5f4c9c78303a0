// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/smooth/chebyshev_series.h"
#include "crowdface/smooth/columns.h"
#include "crowdface/smooth/smoothing_operator.h"
#include "crowdface/smooth/tile_kernels.h"
#include "crowdface/smooth/tiles.h"

namespace crowdface {

/// A head, or any three numbers a vertex, that goes through the filter, and what is wanted of it.
/// Rows stand in the filter's order (`ChebyshevFilter::vertex_of_row`).
template <class T>
struct FilterInput {
  std::vector<Row<T>> values;           ///< x, #V rows
  std::vector<ChebyshevSeries> series;  ///< polynomials Σ_k a_k T_k(W) x to compute
};

/// T_k(W) x at a few vertices for every k: any level there follows without another pass.
struct Probes {
  std::vector<std::uint32_t> vertices;
  Columns values;  ///< terms by 3·#vertices; filled by the filter
};

/// Polynomials of the one-ring mean W of one topology, by the recurrence
/// T_{k+1}(W) x = 2 W T_k(W) x − T_{k−1}(W) x: all that are asked for in one pass. Prepared once,
/// used for every head. Results have the same bits whatever the thread count, the instruction set
/// and the positions it was prepared with.
class ChebyshevFilter {
 public:
  /// \param positions  #V by 3, any head of the topology: tells which vertices lie close together,
  ///                   for speed only.
  ChebyshevFilter(const SmoothingOperator& smoothing, const Positions& positions);

  Index vertex_count() const { return static_cast<Index>(tiling_.order.size()); }
  OperatorKind kind() const { return kind_; }
  /// The vertex that stands in each row of the filter's order.
  std::span<const std::uint32_t> vertex_of_row() const { return tiling_.order; }
  /// The row that each vertex stands in.
  std::span<const std::uint32_t> row_of_vertex() const { return tiling_.row; }

  /// Columns 3·group … 3·group + 2 of x as rows in the filter's order.
  template <class T>
  std::vector<Row<T>> rows_of(const Columns& x, Index group = 0) const;

  /// Evaluates every series of every input.
  /// \param probes  if given: takes T_k(W) x of the first input, `probe_terms` of them.
  /// \return        for each input and each of its series #V rows. A row that no iteration moves
  ///                is x times the sum of the coefficients, to the bit.
  template <class T>
  std::vector<std::vector<RowArray<T>>> run(std::span<const FilterInput<T>> inputs,
                                            Probes* probes = nullptr) const;

 private:
  OperatorKind kind_;
  Tiling tiling_;
};

/// Several polynomials of one set of coordinates in one pass, in double precision:
/// result[o] = Σ_k series[o][k] T_k(W) x.
/// \param x  #V by 3.
/// \throws BrokenPrecondition if the row count is not the filter's.
std::vector<Positions> filter_many(const ChebyshevFilter& filter, const Positions& x,
                                   std::vector<ChebyshevSeries> series);

/// S_L x: positions after `level` iterations (Eq. 1), in O(√level) products. Differs from `iterate`
/// by less than 10⁻⁸ of the head's size.
Positions smooth(const ChebyshevFilter& filter, const Positions& positions, std::uint64_t level);

/// The same for several levels in one pass.
std::vector<Positions> smooth(const ChebyshevFilter& filter, const Positions& positions,
                              std::span<const std::uint64_t> levels);

}  // namespace crowdface
