// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/bust.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "crowdface/core/smooth_step.h"

namespace crowdface::synth {
namespace {

using Eigen::RowVector2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// A vertical section of the bust: the control points of a uniform cubic B-spline. A point consists
/// of the distance from the axis and the height above the rim, in cm. The first point is on the
/// rim.
constexpr std::size_t kPoints = 9;
using Section = std::array<Vector2d, kPoints>;

const Section kSide = {{{6.0, 0},
                        {6.5, -0.9},
                        {8.4, -2.0},
                        {12.3, -2.9},
                        {16.9, -3.6},
                        {20.0, -5.8},
                        {21.0, -11.0},
                        {20.8, -19.0},
                        {19.8, -28.0}}};
const Section kFront = {{{5.7, 0},
                         {5.8, -1.2},
                         {6.1, -2.6},
                         {8.4, -5.0},
                         {11.0, -8.5},
                         {13.1, -13.0},
                         {14.3, -18.0},
                         {14.6, -23.0},
                         {14.0, -28.0}}};
const Section kBack = {{{5.2, 0},
                        {5.5, -1.2},
                        {6.7, -3.0},
                        {9.3, -6.0},
                        {11.0, -10.0},
                        {12.0, -14.5},
                        {12.4, -19.0},
                        {12.3, -23.5},
                        {11.6, -28.0}}};

const Vector3d kRimCentre(0, -16.4,
                          -3.1);  ///< centre of the lower rim of the average head's neck, cm

// The texture shows the bust as a ring: kInner is the radius of the upper rim, kOuter the radius of
// the lower edge, in texture coordinates.
constexpr double kInner = 0.1, kOuter = 0.48;

/// Returns the control points of a section of the bust: the bust's outline in the vertical half
/// plane that begins at the axis and extends in a horizontal direction.
/// \param way  this direction, unit vector (x, z)
Section section_at(const Vector2d& way) {
  const double side = way.x() * way.x();
  const double ahead = std::max(0.0, way.y());
  const double front = ahead * ahead, back = 1 - side - front;
  Section section;
  for (std::size_t k = 0; k < kPoints; ++k) {
    section[k] = side * kSide[k] + front * kFront[k] + back * kBack[k];
  }
  return section;
}

/// Evaluates the spline, which goes from the first to the last point. \param share  parameter, 0 …
/// 1
Vector2d spline_point(const Section& points, double share) {
  const auto at = [&](int k) -> Vector2d {
    const int last = static_cast<int>(kPoints) - 1;
    if (k < 0) return 2 * points[0] - points[1];
    if (k > last) return 2 * points[kPoints - 1] - points[kPoints - 2];
    return points[static_cast<std::size_t>(k)];
  };
  const double place = share * static_cast<double>(kPoints - 1);
  const int k = std::min(static_cast<int>(place), static_cast<int>(kPoints) - 2);
  const double t = place - k, s = 1 - t;
  return (s * s * s * at(k - 1) + (3 * t * t * t - 6 * t * t + 4) * at(k) +
          (3 * s * s * s - 6 * s * s + 4) * at(k + 1) + t * t * t * at(k + 2)) /
         6;
}

/// Returns the distance by which the relief of the collarbones moves a point of the bust away from
/// the axis, cm: positive on a collarbone, negative in the hollow above it and in the notch between
/// both collarbones.
/// \param way    direction from the axis, unit vector (x, z)
/// \param point  distance from the axis and height above the rim, cm
double collarbone_height(const Vector2d& way, const Vector2d& point) {
  const double x = std::abs(way.x() * point.x());
  const double above = point.y() + 5.4 - 0.08 * x;  // above the middle line of the collarbone
  const double bone = smooth_step(0.4, 3.4, x) * smooth_step(16, 11, x);
  const double hollow = smooth_step(1.5, 4, x) * smooth_step(12, 8, x);
  const double notch = biweight(std::min(1.0, std::hypot(x / 2.6, (above - 0.2) / 1.8)));
  const auto ridge = [](double distance) { return biweight(std::min(1.0, std::abs(distance))); };
  return smooth_step(0, 0.3, way.y()) * (0.5 * bone * ridge(above / 1.1) -
                                         0.45 * hollow * ridge((above - 1.7) / 1.5) - 0.45 * notch);
}

Vector3d placed(const Vector2d& way, const Vector2d& point) {
  const double radius = point.x() + collarbone_height(way, point);
  return kRimCentre + Vector3d(radius * way.x(), point.y(), radius * way.y());
}

}  // namespace

Mesh bust_below(const Positions& rim) {
  const auto around = static_cast<std::uint32_t>(rim.rows());
  const std::uint32_t rings = std::max(8U, around / 2);
  Mesh mesh;
  mesh.positions.resize(static_cast<Index>(rings + 1) * rim.rows(), 3);
  mesh.uvs.resize(mesh.positions.rows(), 2);
  for (std::uint32_t i = 0; i < around; ++i) {
    const Vector3d start = rim.row(i).transpose();
    const Vector2d off(start.x() - kRimCentre.x(), start.z() - kRimCentre.z()),
        way = off.normalized();
    Section section = section_at(way);
    // The head's rim differs a little from the rim of the ideal bust; spread the difference over
    // the first control points.
    const Vector2d difference = Vector2d(off.norm(), start.y() - kRimCentre.y()) - section[0];
    constexpr std::array<double, 4> kFade = {1, 1, 0.6, 0.2};
    for (std::size_t k = 0; k < kFade.size(); ++k) section[k] += kFade[k] * difference;
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
      const double share = static_cast<double>(ring) / rings;
      const Index row = static_cast<Index>(ring) * rim.rows() + i;
      const Vector3d point = ring == 0 ? start : placed(way, spline_point(section, share));
      mesh.positions.row(row) = point.transpose();
      const double radius = kInner + (kOuter - kInner) * share;
      mesh.uvs.row(row) << 0.5 + radius * way.x(), 0.5 - radius * way.y();
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t up = ring * around, low = up + around, next = (i + 1) % around;
      mesh.topology.add_face(std::array{low + i, low + next, up + next, up + i});
    }
  }
  mesh.topology.vertex_count = mesh.positions.rows();
  mesh.topology.corner_uvs = mesh.topology.corner_vertices;
  return mesh;
}

Vector3d bust_point(const RowVector2d& uv) {
  const Vector2d off(uv.x() - 0.5, 0.5 - uv.y());
  const double radius = off.norm();
  const Vector2d way = radius > 0 ? Vector2d(off / radius) : Vector2d(0, 1);
  const double share = std::clamp((radius - kInner) / (kOuter - kInner), 0.0, 1.0);
  return placed(way, spline_point(section_at(way), share));
}

}  // namespace crowdface::synth
