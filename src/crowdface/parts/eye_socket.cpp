// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/eye_socket.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/parts/solve3.h"
#include "crowdface/parts/vector3.h"

namespace crowdface {
namespace {

/// How far off the eyeball the rim may be, as a share of its radius, some 12 mm.
constexpr double kLidReach = 0.25;
constexpr double kLeastFront = 0.3;  // cosine of the angle to the axis, at the lids' corners
constexpr std::size_t kDirections = 48;
/// What the mean gap of a lid counts beside all the gaps of the rim.
constexpr double kMeans = 20;
/// What a shift costs beside the gaps: keeps an eyeball in place along its own surface.
constexpr double kHold = 0.02;
/// What a gap counts where the eyeball comes through the rim and did not before.
constexpr double kThrough = 4;

/// Which of kDirections equal sectors a direction in the plane lies in, without an arc tangent: the
/// sectors are equal along a diamond, |x| + |y| = 1.
std::size_t sector(double x, double y) {
  const double sum = std::abs(x) + std::abs(y);
  if (!(sum > 0)) return 0;
  const double along = y >= 0 ? 1 - x / sum : 3 + x / sum;  // 0 … 4
  const auto number = static_cast<std::size_t>(along / 4 * static_cast<double>(kDirections));
  return std::min(number, kDirections - 1);
}

}  // namespace

Lids find_lids(const Positions& positions, const PointGrid& eyeball, const Eigen::Vector3d& centre,
               double radius, const HeadAxes& axes, std::span<const std::uint32_t> skin) {
  const double reach = kLidReach * radius;
  const Eigen::Vector3d side = cross3(axes.up, axes.front);
  struct Innermost {
    std::uint32_t vertex = kNoIndex;
    double cosine = kLeastFront;
  };
  std::array<Innermost, kDirections> rim;
  for (const std::uint32_t v : skin) {
    const Eigen::Vector3d point = positions.row(v).transpose();
    const Eigen::Vector3d from = point - centre;
    const double distance = length3(from);
    if (distance > radius + 2 * reach) continue;
    const double cosine = dot3(from, axes.front) / distance;
    Innermost& innermost = rim[sector(dot3(from, side), dot3(from, axes.up))];
    if (cosine <= innermost.cosine) continue;
    if (eyeball.nearest(point, reach).vertex == kNoIndex) continue;
    innermost = {v, cosine};
  }
  std::vector<std::uint32_t> vertices;
  for (const Innermost& innermost : rim) {
    if (innermost.vertex != kNoIndex) vertices.push_back(innermost.vertex);
  }
  std::sort(vertices.begin(), vertices.end());
  Lids lids;
  for (const std::uint32_t v : vertices) {
    lids.vertices.push_back(v);
    lids.upper.push_back(dot3(positions.row(v).transpose() - centre, axes.up) > 0);
  }
  return lids;
}

Eyeball::Eyeball(const Topology& topology, const FacesAround& faces, const Positions& head,
                 std::span<const std::uint32_t> vertices, const Eigen::Vector3d& centre,
                 double radius, const Lids& lids)
    : topology_(topology),
      faces_(faces),
      head_(head),
      grid_(head, vertices),
      centre_(centre),
      radius_(radius) {
  for (const std::uint32_t v : lids.vertices) {
    const Eigen::Vector3d point = head.row(v).transpose();
    gaps_.push_back(length3(point - ball_under(point)) - radius);
  }
}

Eigen::Vector3d Eyeball::ball_under(const Eigen::Vector3d& point) const {
  const SurfacePoint place =
      nearest_around(topology_, faces_, head_, grid_.nearest(point).vertex, point);
  Eigen::Vector3d outward = normal_at(head_, place);
  if (dot3(outward, place.position - centre_) < 0) outward = -outward;
  return place.position - radius_ * outward;
}

Eigen::Vector3d Eyeball::shift_into(const Lids& lids, const RigidMotion& motion,
                                    const Positions& after) const {
  constexpr int kRounds = 2, kSteps = 3;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> balls(lids.vertices.size());
  for (int round = 0; round < kRounds; ++round) {
    // Where the lids have slid to on the eyeball, looked up on the head it came from.
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const Eigen::Vector3d point = after.row(lids.vertices[i]).transpose();
      balls[i] = motion.apply(ball_under(motion.undo(point - shift)));
    }
    for (int k = 0; k < kSteps; ++k) {
      shift += step(lids, balls, motion.scale * radius_, shift, after);
    }
  }
  return shift;
}

Eigen::Vector3d Eyeball::step(const Lids& lids, const std::vector<Eigen::Vector3d>& balls,
                              double radius, const Eigen::Vector3d& shift,
                              const Positions& after) const {
  const std::size_t count = lids.vertices.size();
  double a[3][3] = {}, b[3] = {};
  // A shift by x changes a gap by −x · u.
  const auto add = [&](double weight, const Eigen::Vector3d& u, double wide) {
    for (Index r = 0; r < 3; ++r) {
      for (Index c = 0; c < 3; ++c) a[r][c] += weight * u(r) * u(c);
      b[r] += weight * u(r) * wide;
    }
  };
  struct {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    double wide = 0, count = 0;
  } mean[2];
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d from = after.row(lids.vertices[i]).transpose() - balls[i] - shift;
    const double length = length3(from);
    if (!(length > 0)) continue;
    const Eigen::Vector3d u = from / length;
    const double gap = length - radius, wide = gap - gaps_[i];
    add(gap < 0 && gaps_[i] >= 0 ? kThrough : 1, u, wide);
    auto& lid = mean[lids.upper[i] ? 1 : 0];
    lid.u += u;
    lid.wide += wide;
    lid.count += 1;
  }
  for (const auto& lid : mean) {
    if (lid.count == 0) continue;
    add(kMeans * static_cast<double>(count), lid.u / lid.count, lid.wide / lid.count);
  }
  const double hold = kHold * static_cast<double>(count);
  if (count == 0) return Eigen::Vector3d::Zero();
  for (Index r = 0; r < 3; ++r) {
    a[r][r] += hold;
    b[r] -= hold * shift(r);
  }
  return solve3(a, b);
}

}  // namespace crowdface
