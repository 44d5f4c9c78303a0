// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/loose_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "head_models/synth/mean_head.h"
#include "head_models/synth/sculpture.h"
#include "head_models/synth/unwrap.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Gap between the edges of the lids and the eyeball, cm.
constexpr double kLidGap = 0.025;
/// Half the width of the dental arches, and their depth, cm.
constexpr double kArcHalfWidth = 2.1, kArcDepth = 1.9;

/// Maps a point (i, j) in [−1, 1]² on a side of a cube to the unit sphere.
Vector3d point_on_ball(int side, double i, double j) {
  // A grid of equal squares on a side of the cube would give larger quads on the sphere in the
  // middle of the side than at its corners. This distortion makes the quads about equally large.
  const auto even = [](double x) { return x * (1.25 - 0.25 * x * x); };
  const double a = even(i), b = even(j);
  const std::array<Vector3d, 6> on_cube = {
      {{a, b, 1}, {1, b, -a}, {-a, b, -1}, {-1, b, a}, {a, 1, -b}, {a, -1, b}}};
  return on_cube[static_cast<std::size_t>(side)].normalized();
}

/// Centre and height of a row of teeth at one position along the row, cm.
struct Row {
  Vector3d middle;
  double height;
};
/// Returns the centre and height at one position of a row of teeth.
/// \param t   position along the row, −1 … 1. \param up  1: upper row, −1: lower row.
Row row_at(double t, double up) {
  const double x = kArcHalfWidth * t * (1.2 - 0.2 * t * t), z = 7.95 - kArcDepth * t * t;
  const double height = (up > 0 ? 0.95 : 0.85) * (1 - 0.25 * t * t);
  // The upper row of teeth is slightly in front of the lower row.
  return {{x * (up > 0 ? 1.0 : 0.96), -7.02 + up * (0.03 + height / 2), z - (up > 0 ? 0 : 0.12)},
          height};
}

/// Returns points on the inner edges of the lids of the average head, at the eye at x > 0.
std::vector<Vector3d> inner_lid_points() {
  std::vector<Vector3d> lid_points;
  constexpr int kPoints = 32;
  for (int i = 0; i < kPoints; ++i) {
    lid_points.push_back(
        mean_skin_with_sockets({SkinPatch::kEye, 1, 4.0 * i / kPoints, 1.2}).position);
  }
  return lid_points;
}

/// The sphere of an eyeball.
struct Ball {
  Vector3d centre;
  double radius;
};
/// Returns the eyeball of a head, placed behind the head's lids.
/// \param lid_points  from inner_lid_points.
Ball ball_behind_lids(const Identity& identity, const std::vector<Vector3d>& lid_points,
                      double side) {
  const auto placed = [&](Vector3d p) {
    p.x() *= side;
    return identity.deform(p);
  };
  std::vector<Vector3d> edge;
  for (const Vector3d& point : lid_points) edge.push_back(placed(point));
  Ball ball{placed(eye_centre()), 0};
  for (const Vector3d& p : edge) ball.radius += (p - ball.centre).norm();
  ball.radius = ball.radius / static_cast<double>(edge.size()) - kLidGap;
  // Move the eyeball back until no lid edge is closer than kLidGap.
  for (int step = 0; step < 6; ++step) {
    double worst = 0;
    for (const Vector3d& p : edge) {
      const Vector3d from = p - ball.centre;
      const double missing = ball.radius + kLidGap - from.norm();
      worst = std::max(worst, missing * from.norm() / std::max(from.z(), 0.5 * from.norm()));
    }
    ball.centre.z() -= worst;
  }
  return ball;
}

}  // namespace

LooseParts::LooseParts(double edge_cm) {
  const auto quads = [&](double length, int least) {
    return std::max(least, static_cast<int>(std::floor(length / edge_cm + 0.5)));
  };
  const int across = quads(kEyeRadius * 1.6, 4);
  for (const double side : {1.0, -1.0}) add_eyeball(side, across);
  const int along = 2 * quads(kArcHalfWidth * 1.5, 10), around = 4 * quads(0.6, 1);
  for (const double up : {1.0, -1.0}) add_teeth(up, along, around);
}

void LooseParts::add_eyeball(double side, int n) {
  first_vertices_.push_back(vertex_count());
  first_faces_.push_back(face_count());
  // Look up vertices by integer coordinates on the cube, so that adjacent sides of the cube share
  // the vertices on their common edge.
  std::vector<std::uint32_t> known(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), kNoIndex);
  const auto vertex = [&](int face, int i, int j) {
    const double a = 2.0 * i / n - 1, b = 2.0 * j / n - 1;
    const std::array<std::array<int, 3>, 6> cells = {
        {{i, j, n}, {n, j, n - i}, {n - i, j, 0}, {0, j, i}, {i, n, n - j}, {i, 0, j}}};
    const auto& cell = cells[static_cast<std::size_t>(face)];
    auto& slot = known[static_cast<std::size_t>((cell[0] * (n + 1) + cell[1]) * (n + 1) + cell[2])];
    if (slot == kNoIndex) {
      slot = static_cast<std::uint32_t>(points_.size());
      const Vector3d p = point_on_ball(face, a, b);
      points_.push_back(p);
      // The texture shows the front half of the eyeball as a disc, and the back half as a ring
      // around this disc.
      const double flat = std::sqrt(p.x() * p.x() + p.y() * p.y());
      const double out = p.z() > 0 ? 0.8 * flat : 0.9 - 0.1 * flat;
      const Vector2d around = flat > 0 ? Vector2d(p.x() / flat, p.y() / flat) : Vector2d(1, 0);
      uvs_.push_back(unwrap_eyeball(side, out * around));
    }
    return slot;
  };
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        corners_.insert(corners_.end(), {vertex(face, i, j), vertex(face, i + 1, j),
                                         vertex(face, i + 1, j + 1), vertex(face, i, j + 1)});
      }
    }
  }
}

void LooseParts::add_teeth(double up, int along, int around) {
  const Index first = vertex_count();
  first_vertices_.push_back(first);
  first_faces_.push_back(face_count());
  constexpr double kThickness = 0.36;
  const int quarter = around / 4;
  for (int i = 0; i <= along; ++i) {
    const double t = 2.0 * i / along - 1;
    const Row row = row_at(t, up);
    const Vector3d tangent =
        row_at(std::min(t + 0.01, 1.0), up).middle - row_at(std::max(t - 0.01, -1.0), up).middle;
    const Vector3d outward = Vector3d(-tangent.z(), 0, tangent.x()).normalized();
    // The surface of a row of fourteen teeth. Between two teeth, the surface is slightly recessed.
    const double tooth = 7 * (t + 1) - std::floor(7 * (t + 1));
    const double proud = 0.035 * (4 * tooth * (1 - tooth) - 0.5);
    for (int k = 0; k < around; ++k) {
      // The row of teeth is a band with a square cross-section. Point k of the cross-section's
      // outline is `q`, a point on the border of the square [−1, 1]²; `side` is its side.
      const int side = k / quarter;
      const double s = 2.0 * (k % quarter) / quarter - 1;
      const Vector2d q = side == 0   ? Vector2d(1, s)
                         : side == 1 ? Vector2d(-s, 1)
                         : side == 2 ? Vector2d(-1, -s)
                                     : Vector2d(s, -1);
      const double out = (q.x() > 0 ? kThickness / 2 + proud : kThickness / 2) * q.x() *
                         (1 - 0.25 * q.y() * q.y());
      points_.push_back(row.middle - out * outward * (outward.z() > 0 ? -1 : 1) +
                        Vector3d(0, row.height / 2 * q.y() * (1 - 0.15 * q.x() * q.x()), 0));
      uvs_.push_back(unwrap_hole(SkinPatch::kMouth, 1,
                                 {0.85 * t * (0.98 - 0.02 * k / around),
                                  up * (0.05 + 0.4 * static_cast<double>(k) / around)}));
    }
  }
  close_band(first, along, around);
}

void LooseParts::close_band(Index first, int along, int around) {
  const auto at = [&](int i, int k) {
    return static_cast<std::uint32_t>(first + i * around + k % around);
  };
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < around; ++k) {
      corners_.insert(corners_.end(), {at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    }
  }
  for (const int end : {0, along}) {
    Vector3d middle = Vector3d::Zero();
    Eigen::RowVector2d uv(0, 0);
    for (int k = 0; k < around; ++k) {
      middle += points_[at(end, k)];
      uv += uvs_[at(end, k)];
    }
    points_.push_back(middle / around);
    uvs_.push_back(uv / around);
    const auto centre = static_cast<std::uint32_t>(points_.size() - 1);
    for (int k = 0; k < around; k += 2) {
      const int from = end == 0 ? k + 2 : k, to = end == 0 ? k : k + 2;
      corners_.insert(corners_.end(), {centre, at(end, from), at(end, k + 1), at(end, to)});
    }
  }
}

void LooseParts::append_to(Topology& topology, TextureCoordinates& uvs) const {
  const auto vertices = static_cast<std::uint32_t>(topology.vertex_count);
  const auto rows = static_cast<std::uint32_t>(uvs.rows());
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    topology.corner_vertices.push_back(vertices + corners_[c]);
    topology.corner_uvs.push_back(rows + corners_[c]);
    if (c % 4 == 3) {
      topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
    }
  }
  topology.vertex_count += vertex_count();
  uvs.conservativeResize(static_cast<Index>(rows) + vertex_count(), 2);
  for (Index i = 0; i < vertex_count(); ++i) {
    uvs.row(static_cast<Index>(rows) + i) = uvs_[static_cast<std::size_t>(i)];
  }
}

Positions LooseParts::positions(const Identity& identity) const {
  Positions out(vertex_count(), 3);
  const std::vector<Vector3d> lid_points = inner_lid_points();
  const Index teeth = first_vertex(LoosePiece::kUpperTeeth);
  for (const LoosePiece eye : {LoosePiece::kLeftEye, LoosePiece::kRightEye}) {
    const bool left = eye == LoosePiece::kLeftEye;  // at x > 0
    const Ball ball = ball_behind_lids(identity, lid_points, left ? 1 : -1);
    const Index end = left ? first_vertex(LoosePiece::kRightEye) : teeth;
    for (Index i = first_vertex(eye); i < end; ++i) {
      out.row(i) = (ball.centre + ball.radius * points_[static_cast<std::size_t>(i)]).transpose();
    }
  }
  // Move the teeth with the inside of the lips, and scale them with the width of the mouth.
  Vector3d before = Vector3d::Zero(), after = Vector3d::Zero();
  constexpr int kPlaces = 16;
  double width_before = 0, width_after = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Vector3d p = mean_skin({SkinPatch::kMouth, 1, 4.0 * i / kPlaces, 2}).position;
    const Vector3d moved = identity.deform(p);
    before += p / kPlaces;
    after += moved / kPlaces;
    width_before += std::abs(p.x());
    width_after += std::abs(moved.x());
  }
  const double scale = width_after / width_before;
  for (Index i = teeth; i < vertex_count(); ++i) {
    out.row(i) = (after + scale * (points_[static_cast<std::size_t>(i)] - before)).transpose();
  }
  return out;
}

}  // namespace crowdface::synth
