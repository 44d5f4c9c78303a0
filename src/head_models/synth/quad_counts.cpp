// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/quad_counts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace crowdface::synth {
namespace {

/// Consecutive rings of an opening: the range of their coordinate b, and the number of rings at one
/// quad per unit.
struct RingSpan {
  double from, to, weight;
};
std::vector<RingSpan> ring_spans(Sheet sheet) {
  if (sheet == Sheet::kEye) return {{0, 1, 6}, {1, 1.2, 1}, {1.2, 2, 4}};
  if (sheet == Sheet::kNostril) return {{0, 1, 4}, {1, 2, 2}};
  if (sheet == Sheet::kMouth) return {{0, 1, 6}, {1, 2, 2}};
  return {{0, 1, 10}};  // the ear
}

int quads(double weight, double scale) {
  return std::max(1, static_cast<int>(std::floor(weight * scale + 0.5)));
}

}  // namespace

QuadCounts::QuadCounts(double quads_per_unit) : scale(quads_per_unit) {
  const auto in_column = [](int k) { return column_unit(k + 1) - column_unit(k); };
  const auto in_row = [](int k) { return row_unit(k + 1) - row_unit(k); };
  for (int i = 0; i + 1 < kColumns; ++i) {
    columns[static_cast<std::size_t>(i)] = quads(in_column(i), scale);
  }
  // The cap continues the columns of the face to the back of the head, so the back has the same
  // counts in reverse order.
  for (std::size_t i = 0; i < kFrontColumn; ++i) columns[columns.size() - 1 - i] = columns[i];
  for (int j = 0; j + 1 < kRows; ++j) rows[static_cast<std::size_t>(j)] = quads(in_row(j), scale);
}

int QuadCounts::column(int k) const {
  const int sum = std::accumulate(columns.begin(), columns.begin() + std::abs(k), 0);
  return k < 0 ? -sum : sum;
}

int QuadCounts::row(int k) const {
  return std::accumulate(rows.begin(), rows.begin() + k, 0);
}

std::vector<double> QuadCounts::rings(Sheet sheet) const {
  std::vector<double> out;
  for (const RingSpan& span : ring_spans(sheet)) {
    const int n = quads(span.weight, scale);
    for (int i = 1; i <= n; ++i) out.push_back(span.from + (span.to - span.from) * i / n);
  }
  return out;
}

Index QuadCounts::vertices() const {
  const Index front = column(kFrontColumn), side = column(kBackColumn) - front;
  const Index around = 2 * column(kColumns - 1);
  Index sum = around * (row(kRows - 1) + 1) + (2 * front - 1) * (side - 1);
  for (const Opening& w : openings()) {
    const Index nx = column(w.column1) - column(w.column0), ny = row(w.row1) - row(w.row0);
    Index piece = 2 * (nx + ny) * static_cast<Index>(rings(w.sheet).size());
    // Subtract the strip's vertices inside the opening. An ear needs no subtraction, because its
    // core has as many vertices.
    if (w.sheet != Sheet::kEar) piece -= (nx - 1) * (ny - 1);
    sum += w.sheet == Sheet::kMouth ? piece : 2 * piece;
  }
  return sum;
}

QuadCounts nearest_counts(Index wanted) {
  QuadCounts best(0.5);
  for (double scale = 0.5; scale < 40; scale *= 1.002) {
    const QuadCounts counts(scale);
    if (std::abs(counts.vertices() - wanted) < std::abs(best.vertices() - wanted)) best = counts;
    if (counts.vertices() > 2 * wanted) break;
  }
  return best;
}

}  // namespace crowdface::synth
