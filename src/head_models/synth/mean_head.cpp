// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/mean_head.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/smooth_step.h"
#include "head_models/synth/ear.h"
#include "head_models/synth/guide.h"
#include "head_models/synth/sculpture.h"
#include "head_models/synth/unwrap.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Returns the ray, from inside the head, to a point on the edge of the eye's opening.
/// \param c  direction from the eye's centre to the point: unit vector (x away from the midline of
///           the face, y up).
GuideRay eye_edge(const Vector2d& c) {
  // Almond shape: pointed corners, an upper lid that is highest towards the nose, and an outer
  // corner slightly above the inner corner.
  const double s = c.y() * (0.72 + 0.28 * c.y() * c.y());
  const double x = 1.52 * c.x() - 0.1 * s;
  const double y = (c.y() > 0 ? 0.53 : 0.47) * s + 0.07 * c.x() - 0.03;
  const double z = std::sqrt(std::max(0.0, kEyeRadius * kEyeRadius - x * x - y * y));
  // The ray is almost parallel to z. At the corners of the eye, the skin lies in front of the
  // eyeball, and a ray from the eyeball's centre would meet this skin far from (x, y).
  return {eye_centre() + 0.95 * Vector3d(x, y, 0), eye_centre() + Vector3d(x, y, z + 0.12)};
}

GuideRay mouth_edge(const Vector2d& c) {
  // Concentrate the points on the short sides of the mouth's opening near the corners of the mouth.
  const double q = c.x() * c.x(), x = 2.42 * c.x() * (1.15 - 0.15 * q);
  const double line = lip_line(x);
  const double gap = 0.03 * c.y() * (1 + 2.2 * q);
  return {{0.4 * x, line + gap, 3}, {x, line + gap, 9.9 - 0.18 * x * x}};
}

GuideRay nostril_edge(const Vector2d& c) {
  const Vector3d centre(0.80, -4.35, 10.35), inside(0.80, -3.45, 10.05);
  const Vector3d lateral(0.31, 0.03, -0.14), forward(-0.13, 0.16, 0.48);
  return {inside, centre + c.x() * lateral + c.y() * forward};
}

GuideRay edge_of(SkinPatch patch, const Vector2d& circle) {
  if (patch == SkinPatch::kEye) return eye_edge(circle);
  return patch == SkinPatch::kNostril ? nostril_edge(circle) : mouth_edge(circle);
}

/// Continues the skin from the edge of a lid inward. Returns the point at the ring coordinate b
/// (LatticePoint::b), 1 … 2. From b = 1 to 1.2, the skin crosses the thickness of the lid; from 1.2
/// to 2, the skin covers the eyeball up to the pupil.
/// \param edge  the point at b = 1, on the edge of the lid
/// \param c     direction around the eye: a point on the unit circle in the front view
Vector3d into_eye(const Vector3d& edge, const Vector2d& c, double b) {
  const Vector3d spoke = edge - eye_centre();
  const Vector3d foot = eye_centre() + kEyeRadius / spoke.norm() *
                                           Vector3d(0.985 * spoke.x(), 0.97 * spoke.y(), spoke.z());
  if (b <= 1.2) return edge + (foot - edge) * ((b - 1) / 0.2);
  const double t = (b - 1.2) / 0.8;
  const Vector2d rim(foot.x() - eye_centre().x(), foot.y());
  const Vector2d flat = rim + t * (0.26 * c - rim);
  const double r2 = kEyeRadius * kEyeRadius;
  // The iris has the shape of a shallow dish, as in carved sculptures.
  const double dish = 0.10 * smooth_step(0.62, 0.42, flat.norm());
  return eye_centre() +
         Vector3d(flat.x(), flat.y(), std::sqrt(std::max(0.04, r2 - flat.squaredNorm())) - dish);
}

/// Like into_eye, for heads with separate eyeballs. From b = 1 to 1.2, the skin crosses the
/// thickness of the lid; from 1.2 to 2, the skin runs back between lid and eyeball.
Vector3d into_socket(const Vector3d& edge, const Vector2d& c, double b) {
  const Vector3d foot = into_eye(edge, c, std::min(b, 1.2)) - eye_centre();
  if (b <= 1.2) return eye_centre() + foot;
  const double t = (b - 1.2) / 0.8, radius = foot.norm();
  // Go backwards along the surface of the eyeball. The lids of a blended face may be thinner than
  // the lids of the heads. Because the pocket stays on the eyeball, the pocket does not protrude
  // through thin lids.
  const Vector3d spoke = foot / radius, gaze(0, 0, 1);
  const Vector3d back = (spoke * spoke.z() - gaze).normalized();
  return eye_centre() + radius * (spoke + 0.14 * t * back).normalized();
}

Vector3d into_opening(SkinPatch patch, const Vector3d& edge, const Vector2d& c, double b) {
  const double t = b - 1;
  if (patch == SkinPatch::kEye) return into_eye(edge, c, b);
  if (patch == SkinPatch::kNostril) {
    const Vector3d centre(0.80, -4.2, 10.35);
    const Vector3d goal = centre + 0.35 * (edge - centre) + Vector3d(-0.1, 1.15, -0.35);
    return edge + t * (goal - edge);
  }
  return edge + t * Vector3d(-0.2 * edge.x(), 0.35 * c.y(), -0.9);
}

SkinPoint on_skin(const GuideRay& ray) {
  const Vector3d position = project_onto_skin(ray.origin, ray.point_near_skin);
  return {position, skin_normal(position), 1};
}

SkinPoint ring_skin(const LatticePoint& lattice_point) {
  const Vector2d circle = point_on_circle(lattice_point.a);
  const GuideRay inner = edge_of(lattice_point.patch, circle);
  if (lattice_point.b >= 1) {
    SkinPoint edge = on_skin(inner);
    if (lattice_point.b == 1) return edge;
    return {into_opening(lattice_point.patch, edge.position, circle, lattice_point.b), edge.normal,
            0};
  }
  const GuideRay outer = opening_ray(opening_of(lattice_point.patch), lattice_point.a);
  const Vector3d inner_skin_point = project_onto_skin(inner.origin, inner.point_near_skin);
  return on_skin(
      {outer.origin + lattice_point.b * (inner.origin - outer.origin),
       outer.point_near_skin + lattice_point.b * (inner_skin_point - outer.point_near_skin)});
}

SkinPoint ear_skin(const LatticePoint& lattice_point) {
  const Vector3d position = ear_position(lattice_point);
  const double relief =
      lattice_point.patch == SkinPatch::kEar ? smooth_step(0.2, 0, lattice_point.b) : 0;
  return {position, skin_normal(position), relief};
}

SkinPoint right_side(const LatticePoint& lattice_point) {
  switch (lattice_point.patch) {
    case SkinPatch::kStrip:
      return on_skin(strip_ray(lattice_point.a, lattice_point.b));
    case SkinPatch::kCap:
      return on_skin(cap_ray(lattice_point.a, lattice_point.b));
    case SkinPatch::kEar:
    case SkinPatch::kEarCore:
      return ear_skin(lattice_point);
    default:
      return ring_skin(lattice_point);
  }
}

SkinPoint on_its_side(SkinPoint point, const LatticePoint& lattice_point) {
  if (lattice_point.side < 0) {
    point.position.x() = -point.position.x();
    point.normal.x() = -point.normal.x();
  }
  return point;
}

}  // namespace

SkinPoint mean_skin(const LatticePoint& lattice_point) {
  return on_its_side(right_side(lattice_point), lattice_point);
}

SkinPoint mean_skin_with_sockets(const LatticePoint& lattice_point) {
  if (lattice_point.patch != SkinPatch::kEye || lattice_point.b <= 1)
    return mean_skin(lattice_point);
  const Vector2d circle = point_on_circle(lattice_point.a);
  const SkinPoint edge = on_skin(eye_edge(circle));
  return on_its_side({into_socket(edge.position, circle, lattice_point.b), edge.normal, 0},
                     lattice_point);
}

}  // namespace crowdface::synth
