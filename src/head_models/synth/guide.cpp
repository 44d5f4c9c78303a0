// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/guide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "head_models/synth/sculpture.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

constexpr int kPlaced = 10;  // hand-placed columns: the first nine and the midline of the back
/// A row of the lattice (see lattice.h) on the average head: the default origin of the row's rays,
/// and the hand-placed points x, y, z of the row, in centimetres.
struct LatticeRow {
  double origin_y, origin_z;
  std::array<std::array<double, 3>, kPlaced> points;
};

// clang-format off
constexpr std::array<LatticeRow, kRows> kLattice = {{
    // edge of the cap, above the forehead
    {2, -0.5, {{{0, 9.0, 6.9}, {0.8, 9.0, 6.85}, {2.0, 8.95, 6.6}, {3.4, 8.8, 5.9}, {4.6, 8.6, 4.7},
                {5.4, 8.4, 3.1}, {5.9, 8.4, 1.0}, {6.1, 8.4, -2.6}, {5.0, 8.2, -5.2}, {0, 8.0, -7.6}}}},
    // forehead
    {2, 0, {{{0, 5.2, 9.2}, {0.85, 5.2, 9.15}, {2.2, 5.2, 8.9}, {3.9, 5.1, 8.0}, {5.3, 5.0, 6.5},
             {6.5, 4.8, 4.2}, {7.2, 5.0, 1.4}, {7.3, 5.0, -3.2}, {6.0, 4.9, -6.2}, {0, 4.6, -9.6}}}},
    // brow
    {1, 0, {{{0, 2.1, 9.6}, {0.6, 2.1, 9.6}, {1.4, 1.9, 9.3}, {3.3, 2.2, 9.0}, {5.3, 1.8, 7.0},
             {6.6, 1.6, 4.4}, {7.2, 1.6, 1.5}, {7.5, 1.6, -3.3}, {6.4, 1.5, -6.6}, {0, 1.6, -9.9}}}},
    // under the eyes
    {-1, 0, {{{0, -1.6, 10.6}, {0.4, -1.6, 10.5}, {1.35, -1.7, 9.3}, {3.2, -2.0, 8.6}, {5.4, -1.7, 6.6},
              {6.7, -1.7, 4.0}, {7.0, -1.7, 1.4}, {6.3, -1.8, -3.6}, {4.7, -2.0, -6.6}, {0, -1.8, -9.2}}}},
    // across the tip of the nose, above the nostrils
    {-3, 0, {{{0, -3.9, 11.9}, {0.26, -3.9, 11.85}, {1.7, -3.1, 9.7}, {3.3, -3.4, 8.5}, {5.2, -3.5, 6.4},
              {6.4, -3.7, 3.8}, {6.7, -4.1, 1.3}, {4.9, -4.1, -3.6}, {3.9, -4.5, -6.0}, {0, -4.3, -8.3}}}},
    // base of the nose
    {-3.5, 0, {{{0, -4.75, 10.0}, {0.26, -4.75, 9.95}, {1.75, -4.6, 9.2}, {3.3, -4.9, 8.4}, {5.0, -5.0, 6.2},
                {6.1, -5.4, 3.7}, {6.2, -6.1, 1.2}, {4.8, -6.3, -3.3}, {3.9, -6.5, -5.8}, {0, -6.4, -7.6}}}},
    // above the lips
    {-5, 0, {{{0, -5.5, 10.2}, {0.4, -5.5, 10.15}, {1.7, -5.6, 9.6}, {3.4, -5.69, 8.2}, {4.9, -6.2, 6.0},
              {5.8, -6.6, 3.6}, {5.9, -7.3, 1.3}, {4.9, -7.8, -2.9}, {4.1, -8.1, -5.5}, {0, -8.2, -7.3}}}},
    // below the lips
    {-7, 0, {{{0, -8.75, 9.4}, {0.45, -8.75, 9.4}, {1.6, -8.65, 9.1}, {3.2, -8.24, 7.9}, {4.6, -8.2, 5.7},
              {5.4, -8.0, 3.4}, {5.5, -8.6, 1.4}, {5.0, -9.3, -2.4}, {4.3, -9.9, -5.2}, {0, -10.2, -7.2}}}},
    // chin
    {-8, 1, {{{0, -10.4, 9.5}, {0.5, -10.4, 9.5}, {1.6, -10.3, 8.8}, {3.0, -9.8, 7.1}, {4.3, -9.3, 5.0},
              {5.0, -9.1, 3.0}, {5.1, -9.6, 1.2}, {5.2, -10.5, -1.9}, {4.9, -11.2, -4.8}, {0, -11.7, -7.2}}}},
    // under the chin, along the edge of the jaw
    {-9, 1.5, {{{0, -11.4, 7.2}, {0.55, -11.4, 7.1}, {1.6, -11.3, 6.7}, {2.9, -11.0, 5.5}, {4.0, -10.7, 3.9},
                {4.6, -10.5, 2.2}, {4.9, -10.7, 0.6}, {5.1, -11.4, -2.0}, {4.9, -12.2, -4.7}, {0, -13.0, -7.4}}}},
    // throat
    {-9.2, 1.8, {{{0, -12.6, 3.6}, {0.7, -12.6, 3.55}, {1.9, -12.6, 3.2}, {3.1, -12.6, 2.4}, {4.1, -12.6, 1.3},
                  {4.8, -12.7, 0.1}, {5.1, -12.8, -1.2}, {5.2, -13.3, -3.2}, {4.7, -13.8, -5.3}, {0, -14.4, -7.7}}}},
    // lower end of the neck
    {-16.5, -2.7, {{{0, -16.5, 2.6}, {0.8, -16.5, 2.5}, {2.1, -16.5, 2.2}, {3.5, -16.5, 1.5}, {4.6, -16.5, 0.5},
                    {5.3, -16.5, -0.6}, {5.6, -16.5, -2.0}, {5.5, -16.5, -4.0}, {4.6, -16.5, -6.0}, {0, -16.5, -8.0}}}},
}};
// clang-format on

/// The origin of a lattice point's ray, instead of the default origin. Around the nose and under
/// the chin, rays start close to the skin, so that they meet the skin at nearly right angles.
struct NearOrigin {
  int row, column;
  double x, y, z;
};
// clang-format off
constexpr std::array<NearOrigin, 13> kNearOrigins = {{
    {3, 0, 0, -1.3, 8.3}, {3, 1, 0, -1.3, 8.3}, {3, 2, 0.1, -1.3, 8.0},
    {4, 0, 0, -3.0, 9.2}, {4, 1, 0, -3.0, 9.2}, {4, 2, 0.2, -3.1, 8.8},
    {5, 0, 0, -3.6, 8.0}, {5, 1, 0.1, -3.6, 8.0}, {5, 2, 0.4, -3.7, 8.0},
    {9, 0, 0, -7.5, 6.6}, {9, 1, 0.2, -7.5, 6.6}, {9, 2, 0.6, -7.5, 6.0}, {9, 3, 1.1, -8.0, 4.2}}};
// clang-format on

/// The rays of all lattice points.
struct GuideRays {
  GuideRays() {
    for (int j = 0; j < kRows; ++j) {
      for (int k = 0; k < kColumns; ++k) place(j, k);
    }
  }

  void place(int j, int k) {
    const LatticeRow& row = kLattice[static_cast<std::size_t>(j)];
    const auto point = [&](int c) {
      const auto& p = row.points[static_cast<std::size_t>(c)];
      return Vector3d(p[0], p[1], p[2]);
    };
    GuideRay ray;
    if (k <= kBackColumn) {
      ray.point_near_skin = point(k);
    } else {
      const double from = column_distance(kBackColumn), to = column_distance(kColumns - 1);
      const double f = (column_distance(k) - from) / (to - from), g = f * (2 - f);
      const Vector3d corner = point(kBackColumn), back = point(kPlaced - 1);
      ray.point_near_skin = {corner.x() * (1 - f), corner.y() + (back.y() - corner.y()) * g,
                             corner.z() + (back.z() - corner.z()) * g};
    }
    ray.origin = {0.4 * ray.point_near_skin.x(), row.origin_y, row.origin_z};
    for (const NearOrigin& o : kNearOrigins) {
      if (o.row == j && o.column == k) ray.origin = {o.x, o.y, o.z};
    }
    // Move the point onto the skin, so that points interpolated between lattice points stay near
    // the skin.
    ray.point_near_skin = project_onto_skin(ray.origin, ray.point_near_skin);
    rays[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] = ray;
  }

  /// Returns the ray of lattice row j and lattice column k. Columns wrap around at the midline of
  /// the back (columns 13 and −13); negative columns are the mirror images of positive ones.
  GuideRay at(int j, int k) const {
    const int around = 2 * (kColumns - 1);
    if (k > kColumns - 1) k -= around;
    if (k < -(kColumns - 1)) k += around;
    GuideRay ray = rays[static_cast<std::size_t>(j)][static_cast<std::size_t>(std::abs(k))];
    if (k < 0) {
      ray.point_near_skin.x() = -ray.point_near_skin.x();
      ray.origin.x() = -ray.origin.x();
    }
    return ray;
  }

  std::array<std::array<GuideRay, kColumns>, kRows> rays;
};

const GuideRays& guide_rays() {
  static const GuideRays instance;
  return instance;
}

/// Like column_distance, but continues beyond the midline of the back.
double wide_column_distance(int k) {
  const int last = kColumns - 1;
  if (k > last) return 2 * column_distance(last) - column_distance(2 * last - k);
  if (k < -last) return -wide_column_distance(-k);
  return column_distance(k);
}

/// Weights of the four knots u at x in [u[1], u[2]]: cubic Hermite interpolation with
/// finite-difference slopes (a Catmull-Rom spline for uneven knots).
std::array<double, 4> cubic_weights(const std::array<double, 4>& u, double x) {
  const double h = u[2] - u[1], t = (x - u[1]) / h;
  const double h00 = (1 + 2 * t) * (1 - t) * (1 - t), h10 = t * (1 - t) * (1 - t);
  const double h01 = t * t * (3 - 2 * t), h11 = t * t * (t - 1);
  const double m1 = h10 * h / (u[2] - u[0]), m2 = h11 * h / (u[3] - u[1]);
  return {-m1, h00 - m2, h01 + m1, m2};
}

/// The four knots around a lattice interval and their interpolation weights.
struct Interval {
  std::array<int, 4> knots;
  std::array<double, 4> weights;
};

Interval columns_around(double a) {
  int k = -(kColumns - 1);
  while (k < kColumns - 2 && column_distance(k + 1) <= a) ++k;
  return {{k - 1, k, k + 1, k + 2},
          cubic_weights({wide_column_distance(k - 1), column_distance(k), column_distance(k + 1),
                         wide_column_distance(k + 2)},
                        a)};
}

Interval rows_around(double b) {
  int j = 0;
  while (j < kRows - 2 && row_distance(j + 1) <= b) ++j;
  const int above = std::max(j - 1, 0), below = std::min(j + 2, kRows - 1);
  return {{above, j, j + 1, below},
          cubic_weights(
              {row_distance(above), row_distance(j), row_distance(j + 1), row_distance(below)}, b)};
}

}  // namespace

GuideRay strip_ray(double a, double b) {
  const Interval columns = columns_around(a), rows = rows_around(b);
  GuideRay sum{Vector3d::Zero(), Vector3d::Zero()};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t k = 0; k < 4; ++k) {
      const GuideRay ray = guide_rays().at(rows.knots[j], columns.knots[k]);
      const double weight = rows.weights[j] * columns.weights[k];
      sum.origin += weight * ray.origin;
      sum.point_near_skin += weight * ray.point_near_skin;
    }
  }
  return sum;
}

GuideRay cap_ray(double a, double b) {
  // A Coons patch between the four sides of the cap's rim, plus a bulge of 2.5 cm.
  const double front = column_distance(kFrontColumn), deep = column_distance(kBackColumn) - front;
  const double s = (a / front + 1) / 2, t = b / deep;
  const double behind = 2 * front + deep;
  const auto rim = [](double unit) { return strip_ray(unit, 0); };
  const GuideRay near_ray = rim(a), far_ray = rim(a >= 0 ? behind - a : -behind - a);
  const GuideRay left = rim(-front - b), right = rim(front + b);
  const GuideRay c00 = rim(-front), c10 = rim(front);
  const GuideRay c01 = rim(-front - deep), c11 = rim(front + deep);
  const auto coons = [&](auto part) -> Vector3d {
    return (1 - t) * part(near_ray) + t * part(far_ray) + (1 - s) * part(left) + s * part(right) -
           (1 - s) * (1 - t) * part(c00) - s * (1 - t) * part(c10) - (1 - s) * t * part(c01) -
           s * t * part(c11);
  };
  GuideRay ray{coons([](const GuideRay& r) { return r.origin; }),
               coons([](const GuideRay& r) { return r.point_near_skin; })};
  ray.point_near_skin.y() += 2.5 * 16 * s * (1 - s) * t * (1 - t);
  return ray;
}

GuideRay opening_ray(const Opening& opening, double around) {
  const double x0 = column_distance(opening.column0), x1 = column_distance(opening.column1);
  const double y0 = row_distance(opening.row0), y1 = row_distance(opening.row1);
  if (around < 1) return strip_ray(x0, y0 + (y1 - y0) * around);
  if (around < 2) return strip_ray(x0 + (x1 - x0) * (around - 1), y1);
  if (around < 3) return strip_ray(x1, y1 + (y0 - y1) * (around - 2));
  return strip_ray(x1 + (x0 - x1) * (around - 3), y0);
}

}  // namespace crowdface::synth
