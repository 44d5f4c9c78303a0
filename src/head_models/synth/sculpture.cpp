// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/sculpture.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/smooth_step.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

// The distance functions of simple bodies, such as ellipsoids and capsules, follow Quilez,
// "Distance functions" (iquilezles.org).

double ellipsoid(const Vector3d& p, const Vector3d& centre, const Vector3d& radii) {
  const Vector3d q = (p - centre).cwiseQuotient(radii);
  const double k0 = q.norm(), k1 = q.cwiseQuotient(radii).norm();
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

/// Distance from p to a capsule from a to b, whose radius changes linearly from ra to rb.
double capsule_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, double ra,
                        double rb) {
  const Vector3d axis = b - a;
  const double t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (p - a - t * axis).norm() - (ra + (rb - ra) * t);
}

/// Signed distance from the smooth union of two bodies, given the distances a and b from the
/// bodies. The edge between the bodies is rounded over a width of about k.
double smooth_union(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}
/// Like smooth_union, for the smooth difference: body a without body b.
double smooth_difference(double a, double b, double k) {
  return -smooth_union(-a, b, k);
}

double skull(const Vector3d& p) {
  double d = ellipsoid(p, {0, 2.7, -1.0}, {7.75, 8.3, 9.35});
  d = smooth_union(d, ellipsoid(p, {0, 3.9, 2.5}, {6.4, 5.9, 6.4}), 2.0);
  return smooth_union(d, ellipsoid(p, {0, -3.0, 2.4}, {6.0, 7.4, 6.4}), 1.6);
}

double jaw(const Vector3d& p) {
  const double mandible = capsule_distance(p, {3.95, -6.9, 1.5}, {1.65, -10.0, 6.6}, 0.95, 1.2);
  const double ramus = capsule_distance(p, {5.5, -2.3, 0.4}, {3.95, -6.8, 1.5}, 1.2, 0.95);
  const double chin = ellipsoid(p, {0, -10.15, 7.45}, {2.2, 1.65, 1.95});
  const double floor = ellipsoid(p, {0, -9.2, 3.7}, {3.2, 2.5, 4.5});
  return smooth_union(smooth_union(smooth_union(mandible, ramus, 1.4), chin, 2.4), floor, 2.0);
}

double cheek(const Vector3d& p) {
  const double front = ellipsoid(p, {3.5, -3.2, 6.0}, {2.4, 2.4, 2.4});
  const double bone = capsule_distance(p, {4.6, -2.3, 5.6}, {6.1, -1.8, 1.4}, 1.0, 0.6);
  const double hollow = ellipsoid(p, {3.0, -6.6, 4.8}, {2.3, 3.2, 3.0});
  const double masseter = ellipsoid(p, {4.15, -5.0, 2.8}, {1.5, 2.6, 2.0});
  return smooth_union(smooth_union(smooth_union(front, bone, 2.0), hollow, 2.2), masseter, 2.0);
}

double nose(const Vector3d& p) {
  double d = capsule_distance(p, {0, 0.7, 8.7}, {0, -3.1, 10.75}, 0.42, 0.74);
  d = smooth_union(d, ellipsoid(p, {0, -3.2, 9.5}, {1.35, 1.7, 1.5}), 0.7);
  d = smooth_union(d, capsule_distance(p, {0.35, 0.2, 8.6}, {0.85, -2.8, 9.5}, 0.4, 0.5), 1.1);
  d = smooth_union(d, ellipsoid(p, {0, -3.4, 10.82}, {0.95, 0.85, 0.85}), 0.6);
  d = smooth_union(d, capsule_distance(p, {0, -3.95, 11.0}, {0, -4.6, 9.9}, 0.32, 0.36), 0.3);
  d = smooth_union(d, capsule_distance(p, {0.4, -3.55, 10.75}, {1.1, -3.75, 10.05}, 0.56, 0.52),
                   0.4);
  return smooth_union(d, ellipsoid(p, {1.15, -3.85, 10.0}, {0.6, 0.66, 0.95}), 0.35);
}

double upper_lip(const Vector3d& p) {
  const double side = capsule_distance(p, {0.5, -6.52, 9.62}, {2.5, -6.88, 8.4}, 0.38, 0.2);
  return smooth_union(side, ellipsoid(p, {0, -6.62, 9.68}, {0.5, 0.4, 0.44}), 0.5);
}

double lower_lip(const Vector3d& p) {
  return smooth_union(capsule_distance(p, {0.5, -7.42, 9.52}, {2.45, -6.97, 8.4}, 0.44, 0.2),
                      ellipsoid(p, {0, -7.48, 9.52}, {0.65, 0.45, 0.45}), 0.6);
}

double neck(const Vector3d& p) {
  // Neck: an elliptic tube that becomes wider towards the shoulders and ends inside the head. Its
  // rear is vertical, its front recedes from the chin downwards.
  const double down = std::max(0.0, -10 - p.y());
  const double z = p.z() + 2.3 + 0.1 * (-10 - p.y());
  const double wide = 4.9 + 0.04 * down * down, deep = 5.15 + 0.014 * down * down;
  const double r = std::sqrt(p.x() * p.x() / (wide * wide) + z * z / (deep * deep));
  double d = -smooth_union((1 - r) * std::min(wide, deep), -(p.y() + 2.5), 3.5);
  // The sternocleidomastoid, from behind the ear to the breastbone below the end of the neck.
  d = smooth_union(d, capsule_distance(p, {4.7, -6.5, -1.6}, {1.6, -18.0, 2.0}, 0.8, 0.7), 1.6);
  // The larynx.
  return smooth_union(d, capsule_distance(p, {0, -12.4, 2.9}, {0, -14.2, 2.6}, 0.5, 0.6), 1.2);
}

}  // namespace

double skin_distance(const Vector3d& point) {
  // Mirror the half head with a smooth approximation of |x|, because |x| itself would leave a
  // crease along the midline.
  constexpr double kJoint = 0.3;
  const double x = std::sqrt(point.x() * point.x() + kJoint * kJoint);
  const Vector3d p(x, point.y(), point.z());
  double d = skull(p);
  d = smooth_union(d, jaw(p), 1.4);
  d = smooth_union(d, cheek(p), 2.4);
  d = smooth_union(d, neck(p), 1.6);
  if (p.z() < 3) return d;
  d = smooth_union(d, ellipsoid(p, {0, -6.9, 6.7}, {2.9, 2.6, 3.0}), 1.6);
  d = smooth_union(d, capsule_distance(p, {0.8, 1.8, 8.45}, {4.3, 1.65, 6.8}, 0.8, 0.5), 1.2);
  d = smooth_union(d, capsule_distance(p, {4.3, 1.65, 6.7}, {5.3, -1.2, 5.3}, 0.5, 0.5), 2.2);
  d = smooth_union(d, ellipsoid(p, {0, 0.9, 7.8}, {1.5, 2.3, 1.45}), 1.2);
  d = smooth_difference(d, ellipsoid(p, {3.2, -0.1, 9.7}, {1.8, 1.15, 2.2}), 0.8);
  d = smooth_difference(d, ellipsoid(p, {1.75, -0.12, 9.0}, {0.5, 0.55, 1.25}), 0.5);
  d = smooth_union(d, (p - eye_centre()).norm() - (kEyeRadius + 0.13), 0.35);
  d = smooth_union(d, nose(p), 0.6);
  // The groove between the lips fades towards the corners of the mouth.
  const double groove = 0.1 + 0.5 * smooth_step(1.5, 2.4, p.x());
  const double lips = smooth_union(upper_lip(p), lower_lip(p), groove);
  d = smooth_union(d, lips, 0.4 + 0.4 * smooth_step(-7.6, -8.4, p.y()));
  return d;
}

double lip_line(double x) {
  const double q = std::min(1.0, x * x / (kMouthHalfWidth * kMouthHalfWidth));
  return -7.0 + 0.25 * q * (1 - q) * (1 - q) + 0.07 * q;
}

Vector3d skin_normal(const Vector3d& point) {
  constexpr double kStep = 1e-4;
  const Vector3d gradient = central_differences(skin_distance, point, kStep);
  const double length = gradient.norm();
  return length > 0 ? Vector3d(gradient / length) : Vector3d(0, 0, 1);
}

Vector3d project_onto_skin(const Vector3d& origin, const Vector3d& point_near_skin) {
  const Vector3d direction = (point_near_skin - origin).normalized();
  const auto at = [&](double t) { return skin_distance(origin + t * direction); };
  // Step from `point_near_skin` along the line, towards the skin, until the distance changes its
  // sign.
  double t0 = (point_near_skin - origin).norm(), d0 = at(t0);
  double t1 = t0, d1 = d0;
  for (int i = 0; i < 80 && (d1 > 0) == (d0 > 0); ++i) {
    t0 = t1;
    d0 = d1;
    t1 -= std::copysign(std::clamp(0.8 * std::abs(d1), 0.02, 0.5), d1);
    d1 = at(t1);
  }
  // Refine the root with the Illinois variant of the false position method.
  for (int i = 0; i < 60 && std::abs(t1 - t0) > 1e-11 && d1 != 0; ++i) {
    const double t = t1 - d1 * (t1 - t0) / (d1 - d0);
    const double d = at(t);
    if ((d > 0) != (d1 > 0)) {
      t0 = t1;
      d0 = d1;
    } else {
      d0 /= 2;
    }
    t1 = t;
    d1 = d;
  }
  return origin + t1 * direction;
}

}  // namespace crowdface::synth
