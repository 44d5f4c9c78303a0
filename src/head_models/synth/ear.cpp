// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/ear.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/smooth_step.h"
#include "head_models/synth/guide.h"
#include "head_models/synth/sculpture.h"
#include "head_models/synth/unwrap.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Profile of the ear, from the skin of the head over the ear's rim into its bowl. For each ring
/// coordinate in kRing, kReach is the distance from the ear's centre (1 on the outline), and
/// kHeight is the height above the skin (1 on the rim).
constexpr std::size_t kKnots = 9;
constexpr double kAttached = 0.18;  // ring coordinates below this lie on the head
constexpr std::array<double, kKnots> kRing = {0, kAttached, 0.32, 0.44, 0.54, 0.64, 0.76, 0.88, 1};
constexpr std::array<double, kKnots> kReach = {1.3, 0.80, 0.88, 1.0, 0.97, 0.86, 0.74, 0.58, 0.46};
constexpr std::array<double, kKnots> kHeight = {0, 0.0, 0.44, 0.90, 1.02, 0.74, 0.92, 0.62, 0.12};

/// Interpolates between knot values at ring coordinate b, by a cubic Hermite spline with
/// finite-difference slopes.
double along(const std::array<double, kKnots>& values, double b) {
  std::size_t k = 0;
  while (k + 2 < kKnots && kRing[k + 1] <= b) ++k;
  const auto slope = [&](std::size_t i) {
    const std::size_t lo = i == 0 ? 0 : i - 1, hi = std::min(i + 1, kKnots - 1);
    return (values[hi] - values[lo]) / (kRing[hi] - kRing[lo]);
  };
  const double h = kRing[k + 1] - kRing[k], t = (b - kRing[k]) / h;
  return values[k] * (1 + 2 * t) * (1 - t) * (1 - t) + values[k + 1] * t * t * (3 - 2 * t) +
         h * t * (1 - t) * ((1 - t) * slope(k) - t * slope(k + 1));
}

/// Maps a point of a disc, which is the ear seen from the side, to a 3D point of the ear.
/// \param place   y up, x to the back; length 1 on the outline.
/// \param height  height above the skin, cm.
Vector3d ear_point(const Vector2d& place, double height) {
  const double up = place.y() * (place.y() > 0 ? 2.75 : 2.85);
  const double back = place.x() * (place.x() > 0 ? 1.6 : 1.1) * (1 + 0.22 * place.y());
  Vector3d guide(0, ear_centre().y() + up, ear_centre().z() - back - 0.2 * up);
  const Vector3d skin = project_onto_skin({0, guide.y(), guide.z()}, {6.5, guide.y(), guide.z()});
  return skin + height * Vector3d(0.86, 0.0, -0.5);
}

/// Height of the ear's rim above the skin of the head, cm. \param round  unit direction from the
/// ear's centre.
double stand_off(const Vector2d& round) {
  const double back = smooth_step(-0.9, 0.9, round.x());
  const double lobe = smooth_step(-0.3, -1.0, round.y());
  return (0.5 + 1.35 * back) * (1 - 0.45 * lobe);
}

/// Height of the ear above the skin of the head, cm. \param round  unit direction from the ear's
/// centre. \param b  LatticePoint::b: 0 at the outline of the ear, 1 at the edge of its core.
double height_at(const Vector2d& round, double b) {
  const double lobe = smooth_step(-0.55, -0.95, round.y());
  const double tragus = smooth_step(0.35, 0.05, (round - Vector2d(-1, -0.1)).norm());
  const double smooth = 0.9 * smooth_step(0, 0.5, b);  // the lobe is flat inside its rim
  const double inner = smooth_step(0.6, 1.0, b);
  double h = along(kHeight, b) * stand_off(round);
  const double flat = smooth * stand_off(round) * (1 - 0.7 * inner);
  h += lobe * (flat - h);
  return h + 0.35 * tragus * smooth_step(0.5, 0.8, b) * smooth_step(1.0, 0.9, b);
}

Vector3d on_ring(double around, double b) {
  const Vector2d round = point_on_circle(around);
  const double front = smooth_step(0.2, -0.8, round.x());
  const double from = std::max(b, kAttached);
  // Remove the overhang of the rim at the front, where the ear meets the cheek.
  const double reach = along(kReach, from) + front * 0.3 * smooth_step(0.5, 0.2, from);
  Vector3d ear = ear_point(reach * round, height_at(round, from));
  if (b >= kAttached) return ear;
  const GuideRay ray = opening_ray(opening_of(SkinPatch::kEar), around);
  const Vector3d edge = project_onto_skin(ray.origin, ray.point_near_skin);
  const double part = b / kAttached;
  const Vector3d between = edge + part * (ear - edge);
  return project_onto_skin({ray.origin.x() * (1 - part), between.y(), between.z()}, between);
}

}  // namespace

Vector3d ear_position(const LatticePoint& lattice_point) {
  if (lattice_point.patch == SkinPatch::kEar) return on_ring(lattice_point.a, lattice_point.b);
  // The point is in the bowl of the ear, inside the innermost ring (b = 1). Map the square patch to
  // a disc. The height falls from the ring's height at the edge of the disc to 0.05 at its centre.
  const Vector2d square(2 * lattice_point.a - 1, 1 - 2 * lattice_point.b);
  const double m = std::max(std::abs(square.x()), std::abs(square.y()));
  if (m == 0) return ear_point({0, 0}, 0.05);
  const Vector2d round = square / square.norm();
  const double edge = height_at(round, 1);
  return ear_point(kReach.back() * m * round, 0.05 + (edge - 0.05) * m * m);
}

}  // namespace crowdface::synth
