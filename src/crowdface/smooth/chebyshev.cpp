// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/chebyshev.h"

#include <algorithm>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/smooth/one_ring_mean.h"

namespace crowdface {
namespace {

void require_columns(const SmoothingOperator& smoothing, const Columns& x) {
  if (x.rows() != smoothing.vertex_count() || x.cols() % 3 != 0) {
    throw InvalidInput(concat("smoothing expects ", smoothing.vertex_count(),
                              " rows of coordinate triples, got ", x.rows(), " by ", x.cols()));
  }
}

/// Series for polynomials that sum to one: so that "does not move" is exact to the bit.
double sum_of(const ChebyshevSeries& series) {
  double sum = 0;
  for (auto a = series.rbegin(); a != series.rend(); ++a) sum += *a;  // small terms first
  constexpr double kRounding = 1e-12;
  return sum > 1 - kRounding && sum < 1 + kRounding ? 1.0 : sum;
}

/// T_1(W) x = W x.
template <int kColumns>
void first_step(const SmoothingOperator& smoothing, const double* x, double* next, Index begin,
                Index end) {
  detail::for_each_mean<kColumns>(smoothing, x, begin, end, [&](Index i, const double* mean) {
    for (int c = 0; c < kColumns; ++c) next[i * kColumns + c] = mean[c];
  });
}

/// T_{k+1}(W) x = 2 W T_k(W) x − T_{k−1}(W) x, written over T_{k−1}, of which only row i is read.
template <int kColumns>
void next_step(const SmoothingOperator& smoothing, const double* now, double* previous, Index begin,
               Index end) {
  detail::for_each_mean<kColumns>(smoothing, now, begin, end, [&](Index i, const double* mean) {
    double* row = previous + i * kColumns;
    for (int c = 0; c < kColumns; ++c) row[c] = 2.0 * mean[c] - row[c];
  });
}

/// The recurrence for up to twelve columns.
template <int kColumns>
void recurrence(const SmoothingOperator& smoothing, const Columns& x, Index terms,
                const std::function<void(Index, Index, Index, const double*)>& visit) {
  Columns previous = x, now(x.rows(), x.cols());
  for (Index k = 0; k < terms; ++k) {
    throw_if_interrupted();
    parallel_blocks(x.rows(), kRowBlock, [&](Index begin, Index end) {
      if (k == 0) return visit(k, begin, end, previous.data() + begin * kColumns);
      if (k == 1) {
        first_step<kColumns>(smoothing, previous.data(), now.data(), begin, end);
      } else {
        next_step<kColumns>(smoothing, previous.data(), now.data(), begin, end);
      }
      visit(k, begin, end, now.data() + begin * kColumns);
    });
    if (k > 0) previous.swap(now);  // `previous` is T_k from here on, `now` T_{k−1}
  }
}

/// Runs of at most twelve columns of x, each handed to `body(first_column, columns)`.
void for_each_column_run(const Columns& x,
                         const std::function<void(Index first, const Columns& columns)>& body) {
  for (Index first = 0; first < x.cols();) {
    const Index count = detail::columns_at_a_time(x.cols() - first);
    if (first == 0 && count == x.cols()) {
      body(0, x);
    } else {
      body(first, x.middleCols(first, count));
    }
    first += count;
  }
}

Index longest(const std::vector<ChebyshevSeries>& series) {
  std::size_t terms = 0;
  for (const ChebyshevSeries& one : series) terms = std::max(terms, one.size());
  return static_cast<Index>(terms);
}

}  // namespace

ChebyshevSeries power_series(OperatorKind kind, std::uint64_t level, double tolerance) {
  if (level == 0) return {1.0};
  const bool lazy = kind == OperatorKind::kLazy;
  const double l = static_cast<double>(level);
  // Umbrella: a_k = 2^{1−L} C(L, (L−k)/2) for k ≡ L (mod 2), so a_{k+2}/a_k = (L−k)/(L+k+2).
  // Lazy: a_k = 2^{1−2L} C(2L, L−k), so a_{k+1}/a_k = (L−k)/(L+k+1). Both halved at k = 0.
  const std::uint64_t stride = lazy ? 1 : 2;
  const std::uint64_t start = lazy ? 0 : level % 2;
  ChebyshevSeries series(start, 0.0);
  double term = 1, sum = 0;
  for (std::uint64_t k = start; k <= level; k += stride) {
    if (k > start) series.resize(k, 0.0);
    series.push_back(k == 0 ? 0.5 * term : term);
    sum += series.back();
    const double kd = static_cast<double>(k);
    const double ratio = (l - kd) / (l + kd + static_cast<double>(stride));
    term *= ratio;
    // The ratios fall, so what follows is less than a geometric series.
    if (term <= tolerance * sum * (1 - ratio)) break;
  }
  double total = 0;
  for (auto a = series.rbegin(); a != series.rend(); ++a) total += *a;
  for (double& a : series) a /= total;  // without that, rims would drift
  return series;
}

void chebyshev_recurrence(const SmoothingOperator& smoothing, const Columns& x, Index terms,
                          const std::function<void(Index, Index, Index, const double*)>& visit) {
  require_columns(smoothing, x);
  if (x.cols() > 12) throw InvalidInput(concat("at most 12 columns at a time, got ", x.cols()));
  detail::with_column_count(
      x.cols(), [&]<int kColumns>() { recurrence<kColumns>(smoothing, x, terms, visit); });
}

std::vector<Columns> filter_many(const SmoothingOperator& smoothing, const Columns& x,
                                 const std::vector<ChebyshevSeries>& series) {
  require_columns(smoothing, x);
  std::vector<Columns> results(series.size(), Columns::Zero(x.rows(), x.cols()));
  for_each_column_run(x, [&](Index first, const Columns& columns) {
    chebyshev_recurrence(smoothing, columns, longest(series),
                         [&](Index k, Index begin, Index end, const double* t) {
                           for (std::size_t o = 0; o < series.size(); ++o) {
                             const double a = k < static_cast<Index>(series[o].size())
                                                  ? series[o][static_cast<std::size_t>(k)]
                                                  : 0;
                             if (a == 0) continue;
                             for (Index i = begin; i < end; ++i) {
                               double* out = results[o].data() + i * x.cols() + first;
                               const double* row = t + (i - begin) * columns.cols();
                               for (Index c = 0; c < columns.cols(); ++c) out[c] += a * row[c];
                             }
                           }
                         });
  });
  for (std::size_t o = 0; o < series.size(); ++o) {
    const double sum = sum_of(series[o]);
    for (Index i = 0; i < x.rows(); ++i) {
      if (smoothing.neighbours(i).empty()) results[o].row(i) = sum * x.row(i);
    }
  }
  return results;
}

Columns filter_each(const SmoothingOperator& smoothing, const Columns& x,
                    const std::vector<ChebyshevSeries>& series) {
  require_columns(smoothing, x);
  if (x.cols() != 3 * static_cast<Index>(series.size())) {
    throw InvalidInput(concat("filtering ", series.size(), " heads expects ", 3 * series.size(),
                              " columns, got ", x.cols()));
  }
  Columns result = Columns::Zero(x.rows(), x.cols());
  for_each_column_run(x, [&](Index first, const Columns& columns) {
    const Index heads = columns.cols() / 3;
    const auto* run = series.data() + first / 3;
    chebyshev_recurrence(smoothing, columns, longest({run, run + heads}),
                         [&](Index k, Index begin, Index end, const double* t) {
                           for (Index g = 0; g < heads; ++g) {
                             const double a = k < static_cast<Index>(run[g].size())
                                                  ? run[g][static_cast<std::size_t>(k)]
                                                  : 0;
                             if (a == 0) continue;
                             for (Index i = begin; i < end; ++i) {
                               double* out = result.data() + i * x.cols() + first + 3 * g;
                               const double* row = t + (i - begin) * columns.cols() + 3 * g;
                               for (int c = 0; c < 3; ++c) out[c] += a * row[c];
                             }
                           }
                         });
  });
  for (Index i = 0; i < x.rows(); ++i) {
    if (!smoothing.neighbours(i).empty()) continue;
    for (Index g = 0; g < static_cast<Index>(series.size()); ++g) {
      result.block<1, 3>(i, 3 * g) =
          sum_of(series[static_cast<std::size_t>(g)]) * x.block<1, 3>(i, 3 * g);
    }
  }
  return result;
}

Positions smooth(const SmoothingOperator& smoothing, const Positions& positions,
                 std::uint64_t level) {
  return filter_each(smoothing, positions, {power_series(smoothing.kind(), level)});
}

}  // namespace crowdface
