// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/chebyshev_filter.h"

#include <algorithm>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// kTileRows is the number of rows per tile. kStepsPerRound is the number of recurrence steps per
/// round; after each round, tiles exchange the rows at their borders. Both values come from
/// measurements (docs/benchmarks.md). With these values, a tile's two vectors and its part of the
/// sums fit into the cache of one core.
constexpr Index kTileRows = 6144;
constexpr int kStepsPerRound = 8;

template <class T>
using RowVector = std::vector<Row<T>>;

/// Number of the tile's own rows whose vertices are fixed. These rows come first, because fixed
/// vertices have valence 0 and rows are sorted by valence.
std::uint32_t fixed_rows(const Tile& tile) {
  return tile.run_count_up_to_ring[0] == 0 ? tile.row_count : tile.runs[0].first_row;
}

double coefficient(const ChebyshevSeries& series, Index k) {
  return k < static_cast<Index>(series.size()) ? series[static_cast<std::size_t>(k)] : 0;
}

/// The state of the recurrence for one input x: T_k(W) x, T_{k−1}(W) x, and for each requested
/// series the sum of its terms so far.
template <class T>
class Recurrence {
 public:
  Recurrence(const Tiling& tiling, const FilterInput<T>& input)
      : tiling_(tiling), input_(input), now_(input.values), previous_(input.values.size()) {
    for (const ChebyshevSeries& series : input.series) {
      terms_ = std::max(terms_, static_cast<Index>(series.size()));
      sums_.emplace_back(input.values.size());
    }
    for (const Tile& tile : tiling.tiles) {  // fixed rows have the same value in every T_k
      std::copy_n(now_.begin() + tile.first_row, fixed_rows(tile),
                  previous_.begin() + tile.first_row);
    }
    next_now_ = now_;
    next_previous_ = previous_;
  }

  Index terms() const { return terms_; }

  /// Initialises the sums of one tile with the term k = 0 of each series.
  void begin(const Tile& tile) {
    for (std::size_t s = 0; s < sums_.size(); ++s) {
      const T a = static_cast<T>(input_.series[s][0]);
      for (std::uint32_t r = tile.first_row; r < tile.first_row + tile.row_count; ++r) {
        for (int c = 0; c < 4; ++c) sums_[s][r].value[c] = a * input_.values[r].value[c];
      }
    }
  }

  /// Runs up to kStepsPerRound steps of the recurrence on one tile, starting at T_k. Adds the new
  /// terms to the sums, in ascending order of k.
  /// \param visit  called with each k and the tile's own rows of T_k(W) x.
  template <class Visit>
  void round(const Tile& tile, Index k, const Visit& visit) {
    thread_local RowVector<T> now, previous;
    load(tile, now_, now);
    load(tile, previous_, previous);
    const auto steps = static_cast<int>(std::min<Index>(kStepsPerRound, terms_ - 1 - k));
    for (int step = 0; step < steps; ++step) {
      const T scale = k == 0 ? T(1) : T(2);  // T_1 = W T_0, T_{k+1} = 2 W T_k − T_{k−1}
      const auto reach = static_cast<std::size_t>(steps - 1 - step);  // rings that later steps need
      recurrence_step<T>(tile.runs.data(), tile.run_count_up_to_ring[reach], tile.neighbours.data(),
                         scale, now.data(), previous.data());
      now.swap(previous);
      ++k;
      add_term(tile, k, now.data());
      visit(k, now.data());
    }
    std::copy_n(now.begin(), tile.row_count, next_now_.begin() + tile.first_row);
    std::copy_n(previous.begin(), tile.row_count, next_previous_.begin() + tile.first_row);
  }

  void end_round() {
    now_.swap(next_now_);
    previous_.swap(next_previous_);
  }

  /// Moves the sums out of this object. First computes the sums of fixed vertices again: every term
  /// T_k(W) x equals x at a fixed vertex, so x times the sum of the coefficients is the exact sum.
  std::vector<RowArray<T>> take_sums() {
    for (std::size_t s = 0; s < sums_.size(); ++s) {
      const T sum = static_cast<T>(coefficient_sum(input_.series[s]));
      for (const Tile& tile : tiling_.tiles) {
        for (std::uint32_t r = tile.first_row; r < tile.first_row + fixed_rows(tile); ++r) {
          for (int c = 0; c < 4; ++c) sums_[s][r].value[c] = sum * input_.values[r].value[c];
        }
      }
    }
    return std::move(sums_);
  }

 private:
  static void load(const Tile& tile, const RowVector<T>& from, RowVector<T>& to) {
    to.resize(tile.local_count());
    std::copy_n(from.begin() + tile.first_row, tile.row_count, to.begin());
    for (std::size_t h = 0; h < tile.halo.size(); ++h) to[tile.row_count + h] = from[tile.halo[h]];
  }

  void add_term(const Tile& tile, Index k, const Row<T>* term) {
    for (std::size_t s = 0; s < sums_.size(); ++s) {
      const double a = coefficient(input_.series[s], k);
      // Skip zero coefficients. Every second coefficient of an umbrella series is zero, and so are
      // all coefficients beyond the end of a short series.
      if (a == 0) continue;
      add_scaled<T>(static_cast<T>(a), term, tile.row_count, sums_[s].data() + tile.first_row);
    }
  }

  const Tiling& tiling_;
  const FilterInput<T>& input_;
  RowVector<T> now_, previous_, next_now_, next_previous_;
  std::vector<RowArray<T>> sums_;
  Index terms_ = 1;
};

/// Stores which probes (vertices to record) lie in each tile, and copies the filter's Chebyshev
/// terms at the probes into RecordedTerms.
class ProbeRows {
 public:
  ProbeRows(const Tiling& tiling, RecordedTerms& probes)
      : probes_(probes), of_tile_(tiling.tiles.size()) {
    std::vector<std::size_t> tile_of_row(tiling.vertex_of_row.size());
    for (std::size_t t = 0; t < tiling.tiles.size(); ++t) {
      const Tile& tile = tiling.tiles[t];
      std::fill_n(tile_of_row.begin() + tile.first_row, tile.row_count, t);
    }
    for (std::size_t p = 0; p < probes.vertices.size(); ++p) {
      const std::uint32_t row = tiling.row_of_vertex[probes.vertices[p]];
      const std::size_t tile = tile_of_row[row];
      of_tile_[tile].push_back({p, row - tiling.tiles[tile].first_row});
    }
  }

  template <class T>
  void take(std::size_t tile, Index k, const Row<T>* rows) const {
    for (const Place& place : of_tile_[tile]) {
      for (Index c = 0; c < 3; ++c) {
        probes_.terms(k, 3 * static_cast<Index>(place.probe) + c) = rows[place.row].value[c];
      }
    }
  }

 private:
  struct Place {
    std::size_t probe;
    std::uint32_t row;
  };
  RecordedTerms& probes_;
  std::vector<std::vector<Place>> of_tile_;
};

/// Returns columns 3·group to 3·group + 2 of x. Row r of the result is row order[r] of x.
template <class T, class Values>
std::vector<Row<T>> rows_in_order(std::span<const std::uint32_t> order, const Values& x,
                                  Index group) {
  require(x.rows() == static_cast<Index>(order.size()) && x.cols() % 3 == 0, "smooth: ", x.rows(),
          " by ", x.cols(), " coordinates of ", order.size(), " vertices");
  std::vector<Row<T>> rows(order.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (Index c = 0; c < 3; ++c) rows[r].value[c] = static_cast<T>(x(order[r], 3 * group + c));
    rows[r].value[3] = 0;
  }
  return rows;
}

Positions positions_of(const ChebyshevFilter& filter, const RowArray<double>& rows) {
  Positions positions(filter.vertex_count(), 3);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (Index c = 0; c < 3; ++c) positions(filter.vertex_of_row()[r], c) = rows[r].value[c];
  }
  return positions;
}

}  // namespace

ChebyshevFilter::ChebyshevFilter(const SmoothingOperator& smoothing, const Positions& positions)
    : kind_(smoothing.kind()),
      tiling_(cut_into_tiles(smoothing, positions, kTileRows, kStepsPerRound)) {}

template <class T>
std::vector<Row<T>> ChebyshevFilter::rows_of(const Columns& x, Index group) const {
  return rows_in_order<T>(tiling_.vertex_of_row, x, group);
}

template <class T>
std::vector<std::vector<RowArray<T>>> ChebyshevFilter::run(std::span<const FilterInput<T>> inputs,
                                                           RecordedTerms* recorded_terms) const {
  std::vector<Recurrence<T>> recurrences;
  recurrences.reserve(inputs.size());
  Index terms = 1;
  for (const FilterInput<T>& input : inputs) {
    recurrences.emplace_back(tiling_, input);
    terms = std::max(terms, recurrences.back().terms());
  }
  std::optional<ProbeRows> probe_rows;
  if (recorded_terms != nullptr) {
    probe_rows.emplace(tiling_, *recorded_terms);
    recorded_terms->terms.resize(recurrences.front().terms(),
                                 3 * static_cast<Index>(recorded_terms->vertices.size()));
    for (std::size_t t = 0; t < tiling_.tiles.size(); ++t) {
      probe_rows->take(t, 0, inputs.front().values.data() + tiling_.tiles[t].first_row);
    }
  }
  for (Index k = 0; k == 0 || k + 1 < terms; k += kStepsPerRound) {
    throw_if_interrupted();
    parallel_for_each(tiling_.tiles.size(), [&](std::size_t t) {
      const Tile& tile = tiling_.tiles[t];
      for (Recurrence<T>& recurrence : recurrences) {
        if (k == 0) recurrence.begin(tile);
        if (k + 1 >= recurrence.terms()) continue;
        const bool probed = probe_rows && &recurrence == &recurrences.front();
        recurrence.round(tile, k, [&](Index term, const Row<T>* rows) {
          if (probed) probe_rows->take(t, term, rows);
        });
      }
    });
    for (Recurrence<T>& recurrence : recurrences) recurrence.end_round();
  }
  std::vector<std::vector<RowArray<T>>> results;
  for (Recurrence<T>& recurrence : recurrences) results.push_back(recurrence.take_sums());
  return results;
}

template std::vector<Row<float>> ChebyshevFilter::rows_of(const Columns&, Index) const;
template std::vector<Row<double>> ChebyshevFilter::rows_of(const Columns&, Index) const;
template std::vector<std::vector<RowArray<float>>> ChebyshevFilter::run(
    std::span<const FilterInput<float>>, RecordedTerms*) const;
template std::vector<std::vector<RowArray<double>>> ChebyshevFilter::run(
    std::span<const FilterInput<double>>, RecordedTerms*) const;

std::vector<Positions> filter_many(const ChebyshevFilter& filter,
                                   const Eigen::Ref<const Positions>& x,
                                   std::vector<ChebyshevSeries> series) {
  const FilterInput<double> input = {rows_in_order<double>(filter.vertex_of_row(), x, 0),
                                     std::move(series)};
  const auto of_input = filter.run<double>({&input, 1});
  std::vector<Positions> results;
  for (const RowArray<double>& rows : of_input.front()) {
    results.push_back(positions_of(filter, rows));
  }
  return results;
}

Positions smooth(const ChebyshevFilter& filter, const Eigen::Ref<const Positions>& positions,
                 std::uint64_t level) {
  return std::move(smooth(filter, positions, std::span(&level, 1)).front());
}

std::vector<Positions> smooth(const ChebyshevFilter& filter,
                              const Eigen::Ref<const Positions>& positions,
                              std::span<const std::uint64_t> levels) {
  std::vector<ChebyshevSeries> series;
  series.reserve(levels.size());
  for (const std::uint64_t level : levels) series.push_back(power_series(filter.kind(), level));
  return filter_many(filter, positions, std::move(series));
}

}  // namespace crowdface
