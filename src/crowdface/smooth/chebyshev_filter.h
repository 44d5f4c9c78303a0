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

/// One vector field to filter (three values per vertex, usually positions), and the polynomials to
/// evaluate on it. Rows are in the filter's row order (`ChebyshevFilter::vertex_of_row`).
template <class T>
struct FilterInput {
  std::vector<Row<T>> values;  ///< the vector field x, #V rows
  /// Coefficients a_k of each polynomial Σ_k a_k T_k(W) x to evaluate. T_k is the k-th Chebyshev
  /// polynomial, W is the matrix of ChebyshevFilter, and x is the vector field `values`.
  std::vector<ChebyshevSeries> series;
};

/// The Chebyshev terms T_k(W) x at a few vertices (the probes), for every k. W is the matrix of
/// ChebyshevFilter, and x is the filtered vector field. The positions of the probes at any
/// smoothing level are linear combinations of the terms, so computing these positions takes no
/// further pass of the filter.
struct RecordedTerms {
  std::vector<std::uint32_t> vertices;  ///< vertex indices of the probes
  /// #terms by 3·#vertices: the filter writes the Chebyshev term T_k(W) x at the probes to row k
  Columns terms;
};

/// Evaluates polynomials of the matrix W (the mean over a vertex's edge-neighbours) of one topology
/// by the Chebyshev recurrence T_{k+1}(W) x = 2 W T_k(W) x − T_{k−1}(W) x. One pass evaluates all
/// requested polynomials. One filter serves all heads of a topology. Results are bit-identical for
/// any thread count and any instruction set.
class ChebyshevFilter {
 public:
  /// \param positions  #V by 3, any head of the topology. The filter uses the positions to group
  ///                   nearby vertices into tiles; the positions affect only the filter's speed,
  ///                   not its results.
  ChebyshevFilter(const SmoothingOperator& smoothing, const Positions& positions);

  Index vertex_count() const { return static_cast<Index>(tiling_.vertex_of_row.size()); }
  /// Returns the kind of the smoothing operator that the filter applies.
  OperatorKind kind() const { return kind_; }
  /// Returns, for each row in the filter's row order, the index of its vertex.
  std::span<const std::uint32_t> vertex_of_row() const { return tiling_.vertex_of_row; }
  /// Returns, for each vertex, its row in the filter's row order.
  std::span<const std::uint32_t> row_of_vertex() const { return tiling_.row_of_vertex; }

  /// Returns columns 3·group to 3·group + 2 of x, with rows in the filter's row order.
  template <class T>
  std::vector<Row<T>> rows_of(const Columns& x, Index group = 0) const;

  /// Evaluates every series of every input.
  /// \param recorded_terms  may be null; receives T_k(W) x of the first input at
  ///                `recorded_terms->vertices`, for all k.
  /// \return        for each input, for each of its series: #V rows. Rows of fixed vertices are
  ///                exactly x times the sum of the series' coefficients.
  template <class T>
  std::vector<std::vector<RowArray<T>>> run(std::span<const FilterInput<T>> inputs,
                                            RecordedTerms* recorded_terms = nullptr) const;

 private:
  OperatorKind kind_;
  Tiling tiling_;  ///< the tiles of the mesh, which determine the order of the rows
};

/// Evaluates several polynomials of the filter's matrix W (see ChebyshevFilter), applied to one
/// vector field x, in one pass and in double precision: result[o] = Σ_k series[o][k] T_k(W) x.
/// \param x  #V by 3.
/// \throws BrokenPrecondition if x does not have one row per vertex of the filter.
std::vector<Positions> filter_many(const ChebyshevFilter& filter,
                                   const Eigen::Ref<const Positions>& x,
                                   std::vector<ChebyshevSeries> series);

/// Computes S_L x, the positions after L = `level` smoothing iterations (Eq. 1), in O(√level)
/// products with W. Results differ from those of `iterate` by less than 10⁻⁸ of the head's size.
Positions smooth(const ChebyshevFilter& filter, const Eigen::Ref<const Positions>& positions,
                 std::uint64_t level);

/// Computes S_L x for several levels L in one filter pass.
std::vector<Positions> smooth(const ChebyshevFilter& filter,
                              const Eigen::Ref<const Positions>& positions,
                              std::span<const std::uint64_t> levels);

}  // namespace crowdface
