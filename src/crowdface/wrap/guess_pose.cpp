// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/guess_pose.h"

#include <array>

#include <Eigen/Geometry>

#include "crowdface/wrap/shape_fit.h"

namespace crowdface {
namespace {

/// Columns are where side, up and front point.
Eigen::Matrix3d frame_of(const Eigen::Vector3d& up, const Eigen::Vector3d& front) {
  Eigen::Matrix3d frame;
  frame << up.cross(front), up, front;
  return frame;
}

struct Extent {
  Eigen::Vector3d low, high;
};

/// Along the columns of a frame.
Extent extent_of(const Positions& positions, const std::vector<bool>& used,
                 const Eigen::Matrix3d& frame) {
  Extent extent{Eigen::Vector3d::Constant(1e300), Eigen::Vector3d::Constant(-1e300)};
  for (Index v = 0; v < positions.rows(); ++v) {
    if (!used[static_cast<std::size_t>(v)]) continue;
    const Eigen::Vector3d p = frame.transpose() * positions.row(v).transpose();
    extent.low = extent.low.cwiseMin(p);
    extent.high = extent.high.cwiseMax(p);
  }
  return extent;
}

}  // namespace

Similarity guess_pose(const SkinMesh& skin, const Positions& rest, const HeadAxes& axes,
                      const ScanSurface& scan, const PoseHint& hint) {
  const Eigen::Matrix3d from = frame_of(axes.up, axes.front), to = frame_of(hint.up, hint.front);
  std::vector<bool> used(static_cast<std::size_t>(scan.scan().positions.rows()), false);
  for (const Triangle& t : scan.scan().triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  const Extent head =
      extent_of(rest, std::vector<bool>(static_cast<std::size_t>(rest.rows()), true), from);
  const Extent found = extent_of(scan.scan().positions, used, to);
  ShapeFitOptions options{.reach_mm = {40, 30, 20, 12}, .steps = 4};
  ShapeFit best;
  best.residual = 1e300;
  // Width is what scans agree in; of height they show more or less. The top of the head, and where the
  // face is farthest in front, are put on each other.
  for (const double wider : {1.0, 0.85, 1.15}) {
    for (const double lower : {0.0, 0.12, -0.12}) {
      Similarity pose;
      pose.rotation = to * from.transpose();
      pose.scale = wider * (found.high.x() - found.low.x()) / (head.high.x() - head.low.x());
      Eigen::Vector3d anchor_from((head.low.x() + head.high.x()) / 2, head.high.y(), head.high.z());
      const Eigen::Vector3d anchor_to((found.low.x() + found.high.x()) / 2, found.high.y(),
                                      found.high.z());
      anchor_from.y() += lower * (head.high.y() - head.low.y());
      pose.translation = to * anchor_to - pose.scale * (to * anchor_from);
      ShapeFit start;
      start.pose = pose;
      const ShapeFit fit = fit_shape(skin, {rest, {}}, scan, {}, start, options);
      if (fit.residual < best.residual) best = fit;
    }
  }
  return best.pose;
}

}  // namespace crowdface
