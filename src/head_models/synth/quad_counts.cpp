// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/quad_counts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace crowdface::synth {
namespace {

/// Consecutive rings of an opening.
struct RingSpan {
  double from, to;                 ///< range of the ring coordinate b
  double ring_count_at_density_1;  ///< number of rings if there is one quad per lattice unit
};
std::vector<RingSpan> ring_spans(SkinPatch patch) {
  if (patch == SkinPatch::kEye) return {{0, 1, 6}, {1, 1.2, 1}, {1.2, 2, 4}};
  if (patch == SkinPatch::kNostril) return {{0, 1, 4}, {1, 2, 2}};
  if (patch == SkinPatch::kMouth) return {{0, 1, 6}, {1, 2, 2}};
  return {{0, 1, 10}};  // the ear
}

int quads(double weight, double scale) {
  return std::max(1, static_cast<int>(std::floor(weight * scale + 0.5)));
}

}  // namespace

QuadCounts::QuadCounts(double density) : quads_per_unit(density) {
  const auto in_column = [](int k) { return column_distance(k + 1) - column_distance(k); };
  const auto in_row = [](int k) { return row_distance(k + 1) - row_distance(k); };
  for (int i = 0; i + 1 < kColumns; ++i) {
    columns[static_cast<std::size_t>(i)] = quads(in_column(i), quads_per_unit);
  }
  // The cap continues the columns of the face to the back of the head, so the back has the same
  // counts in reverse order.
  for (std::size_t i = 0; i < kFrontColumn; ++i) columns[columns.size() - 1 - i] = columns[i];
  for (int j = 0; j + 1 < kRows; ++j)
    rows[static_cast<std::size_t>(j)] = quads(in_row(j), quads_per_unit);
}

int QuadCounts::quads_to_column(int k) const {
  const int sum = std::accumulate(columns.begin(), columns.begin() + std::abs(k), 0);
  return k < 0 ? -sum : sum;
}

int QuadCounts::quads_to_row(int k) const {
  return std::accumulate(rows.begin(), rows.begin() + k, 0);
}

std::vector<double> QuadCounts::ring_coordinates(SkinPatch patch) const {
  std::vector<double> out;
  for (const RingSpan& span : ring_spans(patch)) {
    const int n = quads(span.ring_count_at_density_1, quads_per_unit);
    for (int i = 1; i <= n; ++i) out.push_back(span.from + (span.to - span.from) * i / n);
  }
  return out;
}

Index QuadCounts::vertex_count() const {
  const Index front = quads_to_column(kFrontColumn), side = quads_to_column(kBackColumn) - front;
  const Index around = 2 * quads_to_column(kColumns - 1);
  Index sum = around * (quads_to_row(kRows - 1) + 1) + (2 * front - 1) * (side - 1);
  for (const Opening& w : openings()) {
    const Index nx = quads_to_column(w.column1) - quads_to_column(w.column0),
                ny = quads_to_row(w.row1) - quads_to_row(w.row0);
    Index piece = 2 * (nx + ny) * static_cast<Index>(ring_coordinates(w.patch).size());
    // The initial sum counts the strip's grid without openings. Subtract the grid points inside the
    // opening, except for an ear: the ear's core has as many vertices as the grid there.
    if (w.patch != SkinPatch::kEar) piece -= (nx - 1) * (ny - 1);
    sum += w.patch == SkinPatch::kMouth ? piece : 2 * piece;
  }
  return sum;
}

QuadCounts nearest_counts(Index wanted_vertices) {
  QuadCounts best(0.5);
  for (double scale = 0.5; scale < 40; scale *= 1.002) {
    const QuadCounts counts(scale);
    if (std::abs(counts.vertex_count() - wanted_vertices) <
        std::abs(best.vertex_count() - wanted_vertices))
      best = counts;
    if (counts.vertex_count() > 2 * wanted_vertices) break;
  }
  return best;
}

}  // namespace crowdface::synth
