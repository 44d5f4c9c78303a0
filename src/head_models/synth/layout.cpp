// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>

#include "head_models/synth/quad_counts.h"
#include "head_models/synth/unwrap.h"

namespace crowdface::synth {
namespace {

/// Joins the patches of the skin (see SkinPatch) into one mesh.
class PatchJoiner {
 public:
  explicit PatchJoiner(const QuadCounts& counts)
      : counts_(counts),
        front_(counts.quads_to_column(kFrontColumn)),
        deep_(counts.quads_to_column(kBackColumn) - front_),
        half_(counts.quads_to_column(kColumns - 1)),
        rows_(counts.quads_to_row(kRows - 1)) {}

  Layout sew() {
    for (int k = 0; k + 1 < kColumns; ++k)
      spread(counts_.columns, k, column_distance, column_units_);
    column_units_.push_back(column_distance(kColumns - 1));
    for (int k = 0; k + 1 < kRows; ++k) spread(counts_.rows, k, row_distance, row_units_);
    row_units_.push_back(row_distance(kRows - 1));
    add_strip();
    add_cap();
    for (const Opening& opening : openings()) {
      add_rings(opening, 1);
      if (opening.patch != SkinPatch::kMouth) add_rings(opening, -1);
    }
    layout_.topology.vertex_count = static_cast<Index>(layout_.lattice_points.size());
    layout_.uvs.resize(static_cast<Index>(uvs_.size()), 2);
    for (std::size_t i = 0; i < uvs_.size(); ++i) layout_.uvs.row(static_cast<Index>(i)) = uvs_[i];
    return std::move(layout_);
  }

 private:
  struct Corner {
    std::uint32_t vertex, uv;
  };

  /// Divides interval k of the lattice evenly into mesh columns (or rows), and appends the
  /// coordinates of these columns, in lattice units. Includes the start of the interval, but not
  /// its end.
  /// \param quads_of  number of quads in each interval
  /// \param start_of  returns the coordinate at which an interval starts, in lattice units
  template <class Quads>
  static void spread(const Quads& quads_of, int k, double (*start_of)(int),
                     std::vector<double>& out) {
    const int n = quads_of[static_cast<std::size_t>(k)];
    for (int i = 0; i < n; ++i)
      out.push_back(start_of(k) + (start_of(k + 1) - start_of(k)) * i / n);
  }
  double column_at(int i) const {
    const double unit = column_units_[static_cast<std::size_t>(std::abs(i))];
    return i < 0 ? -unit : unit;
  }
  double row_at(int j) const { return row_units_[static_cast<std::size_t>(j)]; }

  std::uint32_t add_vertex(const LatticePoint& lattice_point) {
    layout_.lattice_points.push_back(lattice_point);
    return static_cast<std::uint32_t>(layout_.lattice_points.size() - 1);
  }
  std::uint32_t add_uv(const LatticePoint& lattice_point) {
    uvs_.push_back(unwrap(lattice_point));
    return static_cast<std::uint32_t>(uvs_.size() - 1);
  }
  Corner add(const LatticePoint& lattice_point) {
    return {add_vertex(lattice_point), add_uv(lattice_point)};
  }
  void add_quad(Corner a, Corner b, Corner c, Corner d) {
    layout_.topology.add_face(std::array{a.vertex, b.vertex, c.vertex, d.vertex},
                              std::array{a.uv, b.uv, c.uv, d.uv});
  }

  /// The range of mesh columns i and mesh rows j that an opening covers, counted in quads.
  struct Span {
    int i0, i1, j0, j1;
  };
  Span span_of(const Opening& w, int side) const {
    const int i0 = counts_.quads_to_column(w.column0), i1 = counts_.quads_to_column(w.column1);
    return {side > 0 ? i0 : -i1, side > 0 ? i1 : -i0, counts_.quads_to_row(w.row0),
            counts_.quads_to_row(w.row1)};
  }

  std::size_t strip_index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(2 * half_ + 1) +
           static_cast<std::size_t>(i + half_);
  }
  Corner& strip(int i, int j) { return strip_[strip_index(i, j)]; }

  void add_strip() {
    std::vector<Span> holes;
    for (const Opening& w : openings()) {
      holes.push_back(span_of(w, 1));
      if (w.patch != SkinPatch::kMouth) holes.push_back(span_of(w, -1));
    }
    strip_.resize(strip_index(half_, rows_) + 1);
    // Leave out the vertices strictly inside openings, and the quads in openings.
    const auto inside = [&](int i, int j) {
      return std::ranges::any_of(
          holes, [&](const Span& s) { return i > s.i0 && i < s.i1 && j > s.j0 && j < s.j1; });
    };
    const auto cut = [&](int i, int j) {
      return std::ranges::any_of(
          holes, [&](const Span& s) { return i >= s.i0 && i < s.i1 && j >= s.j0 && j < s.j1; });
    };
    for (int j = 0; j <= rows_; ++j) {
      for (int i = -half_; i <= half_; ++i) {
        if (inside(i, j)) continue;
        const LatticePoint lattice_point{SkinPatch::kStrip, 1, column_at(i), row_at(j)};
        // The texture seam at the back: one vertex, two texture coordinates.
        if (i == half_)
          strip(i, j) = {strip(-half_, j).vertex, add_uv(lattice_point)};
        else
          strip(i, j) = add(lattice_point);
      }
    }
    for (int j = 0; j < rows_; ++j) {
      for (int i = -half_; i < half_; ++i) {
        if (cut(i, j)) continue;
        add_quad(strip(i, j + 1), strip(i + 1, j + 1), strip(i + 1, j), strip(i, j));
      }
    }
  }

  /// Returns the vertex at column i and row k of the cap's grid. The vertex must be on the rim of
  /// the cap, where cap and strip share their vertices.
  std::uint32_t rim(int i, int k) {
    if (k == 0) return strip(i, 0).vertex;
    if (i == front_) return strip(front_ + k, 0).vertex;
    if (i == -front_) return strip(-front_ - k, 0).vertex;
    return i >= 0 ? strip(2 * front_ + deep_ - i, 0).vertex
                  : strip(-(2 * front_ + deep_ + i), 0).vertex;
  }

  void add_cap() {
    std::vector<Corner> cap;
    const int width = 2 * front_ + 1;
    for (int k = 0; k <= deep_; ++k) {
      for (int i = -front_; i <= front_; ++i) {
        const double b = column_at(front_ + k) - column_at(front_);
        const LatticePoint lattice_point{SkinPatch::kCap, 1, column_at(i), b};
        const bool on_rim = k == 0 || k == deep_ || i == front_ || i == -front_;
        if (k == 0)
          cap.push_back(strip(i, 0));
        else if (on_rim)
          cap.push_back({rim(i, k), add_uv(lattice_point)});
        else
          cap.push_back(add(lattice_point));
      }
    }
    const auto at = [&](int i, int k) {
      return cap[static_cast<std::size_t>(k) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(i + front_)];
    };
    for (int k = 0; k < deep_; ++k) {
      for (int i = -front_; i < front_; ++i) {
        add_quad(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
      }
    }
  }

  /// A mesh vertex on the outline of an opening, with its ring coordinate LatticePoint::a, its mesh
  /// column i and its mesh row j.
  struct OutlineVertex {
    Corner corner;
    double a;
    int i, j;
  };
  /// Returns the ring coordinate (0 … 4 along the four sides, see LatticePoint::a) of a point on an
  /// opening's outline. A point and its mirror image have the same coordinate.
  double around(const Span& s, int side, int i, int j) const {
    const double x0 = column_at(side > 0 ? s.i0 : -s.i1), x1 = column_at(side > 0 ? s.i1 : -s.i0);
    const double y0 = row_at(s.j0), y1 = row_at(s.j1);
    const double x = (column_at(side > 0 ? i : -i) - x0) / (x1 - x0);
    const double y = (row_at(j) - y0) / (y1 - y0);
    if (x <= 0 && y < 1) return y;
    if (y >= 1 && x < 1) return 1 + x;
    if (x >= 1 && y > 0) return 3 - y;
    return 4 - x;
  }

  /// Returns the outline of an opening, counter-clockwise from the opening's upper left corner,
  /// seen from outside the head.
  std::vector<OutlineVertex> outline(const Span& s, int side) {
    std::vector<OutlineVertex> out;
    const auto put = [&](int i, int j) {
      out.push_back({strip(i, j), around(s, side, i, j), i, j});
    };
    for (int j = s.j0; j < s.j1; ++j) put(s.i0, j);
    for (int i = s.i0; i < s.i1; ++i) put(i, s.j1);
    for (int j = s.j1; j > s.j0; --j) put(s.i1, j);
    for (int i = s.i1; i > s.i0; --i) put(i, s.j0);
    return out;
  }

  /// Fills an opening with concentric rings of quads; for an ear, also fills the innermost ring
  /// with a core of quads.
  void add_rings(const Opening& opening, int side) {
    const Span span = span_of(opening, side);
    const std::vector<OutlineVertex> first = outline(span, side);
    const std::size_t n = first.size();
    std::vector<Corner> ring, next(n);
    for (const OutlineVertex& s : first) ring.push_back(s.corner);
    for (const double b : counts_.ring_coordinates(opening.patch)) {
      for (std::size_t p = 0; p < n; ++p) {
        next[p] = add({opening.patch, static_cast<double>(side), first[p].a, b});
      }
      for (std::size_t p = 0; p < n; ++p) {
        const std::size_t q = (p + 1) % n;
        add_quad(ring[p], ring[q], next[q], next[p]);
      }
      ring = next;
    }
    if (opening.patch == SkinPatch::kEar) add_core(span, side, first, ring);
  }

  /// Fills the innermost ring of an ear with a grid of quads.
  /// \param first  outline of the opening. \param ring  corners of the innermost ring.
  void add_core(const Span& s, int side, const std::vector<OutlineVertex>& first,
                const std::vector<Corner>& ring) {
    std::map<std::pair<int, int>, Corner> core;
    for (std::size_t p = 0; p < first.size(); ++p) core[{first[p].i, first[p].j}] = ring[p];
    const double x0 = column_at(s.i0), x1 = column_at(s.i1), y0 = row_at(s.j0), y1 = row_at(s.j1);
    for (int j = s.j0 + 1; j < s.j1; ++j) {
      for (int i = s.i0 + 1; i < s.i1; ++i) {
        const double across = (column_at(i) - x0) / (x1 - x0);
        core[{i, j}] = add({SkinPatch::kEarCore, static_cast<double>(side),
                            side > 0 ? across : 1 - across, (row_at(j) - y0) / (y1 - y0)});
      }
    }
    for (int j = s.j0; j < s.j1; ++j) {
      for (int i = s.i0; i < s.i1; ++i) {
        add_quad(core[{i, j + 1}], core[{i + 1, j + 1}], core[{i + 1, j}], core[{i, j}]);
      }
    }
  }

  QuadCounts counts_;
  int front_, deep_, half_, rows_;  // numbers of quads: half the face, side, half the head, rows
  std::vector<double> column_units_, row_units_;
  std::vector<Corner> strip_;
  std::vector<Eigen::RowVector2d> uvs_;
  Layout layout_;
};

}  // namespace

Layout make_layout(Index vertices) {
  return PatchJoiner(nearest_counts(vertices)).sew();
}

}  // namespace crowdface::synth
