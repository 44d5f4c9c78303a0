// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/ball_radii.h"
#include "crowdface/parts/eye_socket.h"
#include "crowdface/parts/gap_section.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/shapes/lid_closure.h"

namespace crowdface {

/// The lids of one eye, measured without the program's own places: how far they are open below
/// points of the upper lid's rim, and how deep their outer skin is in the eyeball.
class MeasuredLids {
 public:
  static constexpr std::size_t kPlanes = 64;

  /// \param head_set, parts, part  must outlive this object.
  /// \param skin                its vertices, ascending
  MeasuredLids(const HeadSet& head_set, std::span<const std::uint32_t> skin, const PartList& parts,
               const Part& part, const Positions& neutral, const HeadAxes& axes)
      : faces_(head_set),
        parts_(parts),
        part_(part),
        axes_(axes),
        ones_(part.vertices.size(), 1.0),
        mean_(mean_head(head_set)),
        around_(head_set.topology) {
    const BallRadii ball = map_in(neutral);
    TemplateEye eye{ball,
                    find_lids(neutral, PointGrid(neutral, part.vertices), ball.centre(),
                              ball.radius(), axes, skin),
                    {}};
    for (const std::uint32_t r : eye.lids.rim) rim_.push_back(eye.lids.vertices[r]);
    for (const std::uint32_t v : skin) {
      double nearest = std::numeric_limits<double>::max();
      for (const std::uint32_t r : rim_) {
        nearest = std::min(nearest, (row3(neutral, v) - row3(neutral, r)).norm());
      }
      if (nearest < kLid * ball.radius()) eye.skin_vertices.push_back(v);
    }
    std::vector<signed char> side(static_cast<std::size_t>(neutral.rows()), 0);
    mark_lid_sides(eye, neutral, side);
    const std::vector<Triangle> triangles = triangles_of(head_set.topology);
    for (const Triangle& t : triangles) {
      const int sum = side[t[0]] + side[t[1]] + side[t[2]];
      if (sum == 3) upper_.push_back(t);
      if (sum == -3) lower_.push_back(t);
    }
    const Positions normals = vertex_normals_or_zero(triangles, neutral);
    for (const std::uint32_t v : eye.skin_vertices) {
      const BallRadii::Gap gap = ball.gap_at(row3(neutral, v) - ball.centre());
      if (gap.normal.dot(row3(normals, v)) > 0) outer_.push_back(v);
    }
  }

  /// Straight down from points of the upper lid's rim to the lower lid; none where nothing is
  /// below. The points are those of the skin that are lowest on the template in its shape, in
  /// planes that divide the opening evenly.
  std::vector<std::optional<double>> gaps(const Positions& mesh) const {
    std::vector<std::optional<double>> gaps;
    for (const EdgePoint& point : points_) {
      const Eigen::Vector3d at =
          (1 - point.fraction) * row3(mesh, point.a) + point.fraction * row3(mesh, point.b);
      const Cut below = highest(lower_, mesh, at.dot(axes_.side()), 1);
      const double gap = at.dot(axes_.up) - below.height;
      gaps.push_back(std::isfinite(gap) ? std::optional(gap) : std::nullopt);
    }
    return gaps;
  }

  /// \param mesh  the template in the shape whose gaps are measured
  void find_points(const Positions& neutral, const Positions& mesh) {
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const std::uint32_t v : rim_) {
      low = std::min(low, row3(neutral, v).dot(axes_.side()));
      high = std::max(high, row3(neutral, v).dot(axes_.side()));
    }
    points_.clear();
    for (std::size_t k = 0; k < kPlanes; ++k) {
      const double at = low + (high - low) * (static_cast<double>(k) + 0.5) / kPlanes;
      const Cut cut = highest(upper_, mesh, at, -1);
      if (std::isfinite(cut.height)) points_.push_back(cut.point);
    }
  }

  /// How deep the lids' outer skin, that which looks away from the eyeball at rest, is in the
  /// eyeball.
  std::vector<double> depths(const BallRadii& ball, const Positions& mesh) const {
    std::vector<double> depths;
    for (const std::uint32_t v : outer_) {
      depths.push_back(std::max(0.0, -ball.gap_at(row3(mesh, v) - ball.centre()).gap));
    }
    return depths;
  }

  BallRadii map_in(const Positions& mesh) const {
    const ComponentShape& ball = parts_.shapes[part_.ball_component];
    const RigidMotion motion = fit_rigid_motion(mean_, mesh, part_.vertices, ones_);
    return BallRadii(faces_.topology, around_, mesh, part_.ball_vertices, motion.apply(ball.centre),
                     motion.scale * ball.radius, axes_);
  }

  /// How far the rim goes at most.
  double moved(const Displacements& moves) const {
    double most = 0;
    for (const std::uint32_t v : rim_) {
      const auto at = std::lower_bound(moves.vertices.begin(), moves.vertices.end(), v);
      if (at == moves.vertices.end() || *at != v) continue;
      most = std::max(most, row3(moves.moves, at - moves.vertices.begin()).norm());
    }
    return most;
  }

 private:
  static constexpr double kLid = 0.35;  ///< of the eyeball's radius: skin so near to the rim is lid

  struct Cut {
    double height;
    EdgePoint point;
  };
  /// Where sign times height is largest of the triangles' section with the plane `side = at`; −∞ if
  /// none meets it.
  Cut highest(const std::vector<Triangle>& triangles, const Positions& mesh, double at,
              double sign) const {
    Cut most{-std::numeric_limits<double>::infinity(), {}};
    for (const Triangle& t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        const Eigen::Vector3d p = row3(mesh, a), q = row3(mesh, b);
        const double x = p.dot(axes_.side()) - at, y = q.dot(axes_.side()) - at;
        if ((x < 0) == (y < 0)) continue;
        const double share = x / (x - y), height = sign * (p + share * (q - p)).dot(axes_.up);
        if (height > most.height) most = {height, {a, b, share}};
      }
    }
    return most;
  }

  const HeadSet& faces_;
  const PartList& parts_;
  const Part& part_;
  HeadAxes axes_;
  std::vector<double> ones_;
  Positions mean_;
  VertexFaces around_;
  std::vector<std::uint32_t> rim_, outer_;
  std::vector<Triangle> upper_, lower_;
  std::vector<EdgePoint> points_;
};

}  // namespace crowdface
