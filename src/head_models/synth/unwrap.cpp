// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/unwrap.h"

#include <array>
#include <cmath>

namespace crowdface::synth {
namespace {

// Widths and heights that the lattice intervals have in the texture. The unit is about 1 cm on the
// head; the face is slightly enlarged.
constexpr std::array<double, kColumns - 1> kWidths = {0.5, 1.3, 1.9, 2.2, 1.9, 2.4, 3.6,
                                                      2.4, 1.9, 1.9, 1.9, 1.3, 0.8};
constexpr std::array<double, kRows - 1> kHeights = {3.6, 3.0, 4.4, 2.0, 1.8, 1.2,
                                                    3.4, 1.8, 2.2, 2.6, 3.6};
constexpr double kCapHeight = 11, kMargin = 0.004;

double piecewise(double unit, double (*knot)(int), const double* sizes, int intervals) {
  double sum = 0;
  for (int k = 0; k < intervals; ++k) {
    const double from = knot(k), to = knot(k + 1);
    if (unit <= to || k == intervals - 1) return sum + sizes[k] * (unit - from) / (to - from);
    sum += sizes[k];
  }
  return sum;
}

/// Converts a signed distance from the midline of the face: from lattice units to the unit of
/// kWidths.
double across(double lattice_units) {
  const double x =
      piecewise(std::abs(lattice_units), column_distance, kWidths.data(), kColumns - 1);
  return lattice_units < 0 ? -x : x;
}

/// Converts a distance down from the cap: from lattice units to the unit of kHeights.
double down(double lattice_units) {
  return piecewise(lattice_units, row_distance, kHeights.data(), kRows - 1);
}

/// Half the width of the texture, in the unit of kWidths.
double half_width() {
  static const double half = across(column_distance(kColumns - 1));
  return half;
}
/// Height of the strip in the texture, in the unit of kHeights. The strip lies below the cap.
double strip_height() {
  static const double height = down(row_distance(kRows - 1));
  return height;
}

Eigen::RowVector2d scaled(double x, double y) {
  const double half = half_width(), height = strip_height();
  return {kMargin + (1 - 2 * kMargin) * (x + half) / (2 * half),
          kMargin + (1 - 2 * kMargin) * (height - y) / (height + kCapHeight)};
}

// Each eyeball's texture area is a disc in a free corner of the texture, beside the area of the cap
// (the patch on top of the head).
constexpr double kDisc = 4.9;  ///< radius of each disc, in the unit of kWidths (about 1 cm)
const Eigen::Vector2d& disc_centre() {
  static const Eigen::Vector2d centre((across(column_distance(kFrontColumn)) + half_width()) / 2,
                                      -kCapHeight / 2);
  return centre;
}

/// Half-axes of two ellipses in the texture area of an eye, a nostril or the mouth. The area is the
/// square [−1, 1]². `edge` is the edge of the opening. The skin that continues from the edge into
/// the head lies between `edge` and `hole`.
struct HalfAxes {
  Eigen::Vector2d edge, hole;
};
HalfAxes half_axes_of(SkinPatch patch) {
  if (patch == SkinPatch::kEye) return {{0.62, 0.36}, {0.50, 0.28}};
  if (patch == SkinPatch::kNostril) return {{0.45, 0.45}, {0.2, 0.2}};
  if (patch == SkinPatch::kMouth) return {{0.8, 0.12}, {0.6, 0.03}};
  return {{0.4, 0.4}, {0.4, 0.4}};
}

Eigen::Vector2d in_opening(const LatticePoint& lattice_point) {
  const HalfAxes axes = half_axes_of(lattice_point.patch);
  if (lattice_point.patch == SkinPatch::kEarCore) {
    return {axes.edge.x() * (2 * lattice_point.a - 1), axes.edge.y() * (1 - 2 * lattice_point.b)};
  }
  const Eigen::Vector2d start = point_on_square(lattice_point.a);
  const Eigen::Vector2d round =
      lattice_point.patch == SkinPatch::kEar ? start : start / start.norm();
  const Eigen::Vector2d edge = round.cwiseProduct(axes.edge);
  if (lattice_point.b <= 1) return start + (edge - start) * lattice_point.b;
  return edge + (round.cwiseProduct(axes.hole) - edge) * (lattice_point.b - 1);
}

/// Maps a point q in the square [−1, 1]² of an opening to texture coordinates.
Eigen::RowVector2d unwrap_opening(SkinPatch patch, double side, const Eigen::Vector2d& q) {
  const Opening& w = opening_of(patch);
  const double x0 = across(column_distance(w.column0)), x1 = across(column_distance(w.column1));
  const double y0 = down(row_distance(w.row0)), y1 = down(row_distance(w.row1));
  return scaled(side * ((x0 + x1) / 2 + (x1 - x0) / 2 * q.x()),
                (y0 + y1) / 2 - (y1 - y0) / 2 * q.y());
}

}  // namespace

Eigen::Vector2d point_on_square(double around) {
  if (around < 1) return {-1, 1 - 2 * around};
  if (around < 2) return {2 * (around - 1) - 1, -1};
  if (around < 3) return {1, 2 * (around - 2) - 1};
  return {1 - 2 * (around - 3), 1};
}

Eigen::RowVector2d unwrap_eyeball(double side, const Eigen::Vector2d& place) {
  const Eigen::Vector2d& centre = disc_centre();
  return scaled(side * centre.x() + kDisc * place.x(), centre.y() - kDisc * place.y());
}

Eigen::Vector2d eyeball_disc_point(const Eigen::RowVector2d& uv) {
  const Eigen::RowVector2d low = scaled(-half_width(), strip_height()),
                           high = scaled(half_width(), -kCapHeight);
  const double x = half_width() * (2 * (uv.x() - low.x()) / (high.x() - low.x()) - 1);
  const double y =
      strip_height() - (strip_height() + kCapHeight) * (uv.y() - low.y()) / (high.y() - low.y());
  const Eigen::Vector2d& centre = disc_centre();
  return {(std::abs(x) - centre.x()) / kDisc, (centre.y() - y) / kDisc};
}

double strip_v(double units_below_cap) {
  return scaled(0, down(units_below_cap)).y();
}

Eigen::RowVector2d unwrap_hole(SkinPatch patch, double side, const Eigen::Vector2d& place) {
  return unwrap_opening(patch, side, place.cwiseProduct(half_axes_of(patch).hole));
}

Eigen::RowVector2d unwrap(const LatticePoint& lattice_point) {
  if (lattice_point.patch == SkinPatch::kStrip)
    return scaled(across(lattice_point.a), down(lattice_point.b));
  if (lattice_point.patch == SkinPatch::kCap) {
    const double deep = column_distance(kBackColumn) - column_distance(kFrontColumn);
    return scaled(across(lattice_point.a), -kCapHeight * lattice_point.b / deep);
  }
  const SkinPatch patch =
      lattice_point.patch == SkinPatch::kEarCore ? SkinPatch::kEar : lattice_point.patch;
  return unwrap_opening(patch, lattice_point.side, in_opening(lattice_point));
}

}  // namespace crowdface::synth
