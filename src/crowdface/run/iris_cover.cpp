// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/iris_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <Eigen/LU>

#include "crowdface/core/contains.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/render/eyeballs.h"

namespace crowdface {
namespace {

constexpr int kTexturePx = 512;  // enough for the strands of a fringe

/// Points in the unit disc, nearly evenly spread: a square grid without its corners.
std::vector<Eigen::Vector2d> disc_points() {
  constexpr int kSteps = 4;  // from the centre to the edge
  std::vector<Eigen::Vector2d> points;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const Eigen::Vector2d point = Eigen::Vector2d(i, j) / (kSteps + 0.5);
      if (point.squaredNorm() <= 1) points.push_back(point);
    }
  }
  return points;
}

}  // namespace

IrisCover::IrisCover(const Config& config, const Inputs& inputs, FaceAttachments& attachments,
                     std::function<const FaceBuilder&()> builder)
    : inputs_(inputs),
      axes_(head_axes(config)),
      attachments_(attachments),
      builder_(std::move(builder)),
      surfaces_(kTexturePx, false) {
  if (inputs.attachments.empty()) return;
  constexpr double kNear = 1.5;  // in radii of the eyeball
  const std::vector<Eye> eyes = eyes_of(inputs.attachments.fitted_head_positions);
  for (const Attachment& item : inputs.attachments.items) {
    if (item.kind != "hair") continue;
    const auto is_near = [&](const Eye& eye) {
      for (Index v = 0; v < item.file.positions.rows(); ++v) {
        const Eigen::Vector3d place = item.file.positions.row(v).transpose() - eye.centre;
        const double ahead = place.dot(axes_.front);
        const double beside = (place - ahead * axes_.front).norm();
        if (ahead > 0 && beside < kNear * eye.radius) return true;
      }
      return false;
    };
    if (std::ranges::any_of(eyes, is_near)) items_near_eyes_.push_back(item.name);
  }
}

std::vector<IrisCover::Eye> IrisCover::eyes_of(const Positions& positions) const {
  std::vector<Eye> eyes;
  for (const Part& part : inputs_.parts.parts) {
    if (!part.is_eyeball) continue;
    const Eigen::AlignedBox3d box = bounding_box(positions, part.ball_vertices);
    eyes.push_back({box.center(), box.sizes().maxCoeff() / 2});
  }
  return eyes;
}

double IrisCover::covered_fraction(const std::string& item, const FacePlan& face) {
  if (!contains(items_near_eyes_, item)) return 0;
  FacePlan wearer = face;
  wearer.attachments = items_near_eyes_;  // in parallel at the first call
  attachments_.bind({&wearer, 1});
  wearer.attachments = {item};
  const Positions positions = builder_().rebuild(face.recipe, previous_face_);
  const auto placed = attachments_.attachments_of(wearer, positions);
  double most = 0;
  for (const Eye& eye : eyes_of(positions)) {
    most = std::max(most, covered_fraction(eye, placed.front()));
  }
  return most;
}

double IrisCover::covered_fraction(const Eye& eye, const PlacedAttachment& hair) const {
  const AttachmentSurface& surface = surfaces_.at(*hair.item);
  const Eigen::Vector3d side = axes_.side();
  const double iris = kIrisRadius * eye.radius;
  static const std::vector<Eigen::Vector2d> points = disc_points();
  std::vector<double> passing(points.size(), 1);  // light of each point that passes the hair
  for (std::uint32_t q = 0; q < surface.quads().size(); ++q) {
    const Quad& quad = surface.quads()[q];
    // Project the corners onto a plane in front of the eye. The origin is the centre of the eye,
    // the unit is the radius of the iris.
    std::array<Eigen::Vector2d, 4> corners;
    double ahead = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d place = hair.positions.row(quad[k]).transpose() - eye.centre;
      corners[k] = Eigen::Vector2d(place.dot(side), place.dot(axes_.up)) / iris;
      ahead = std::max(ahead, place.dot(axes_.front));
    }
    if (ahead <= 0) continue;  // behind the eye
    for (const std::array<std::size_t, 3> triangle :
         {std::array<std::size_t, 3>{0, 1, 2}, std::array<std::size_t, 3>{0, 2, 3}}) {
      if (quad[triangle[1]] == quad[triangle[2]]) continue;  // the quad is a triangle
      Eigen::Matrix2d edges;
      edges << corners[triangle[1]] - corners[triangle[0]],
          corners[triangle[2]] - corners[triangle[0]];
      if (edges.determinant() == 0) continue;
      const Eigen::Matrix2d inverse = edges.inverse();
      for (std::size_t p = 0; p < points.size(); ++p) {
        const Eigen::Vector2d share = inverse * (points[p] - corners[triangle[0]]);
        if (share.minCoeff() < 0 || share.sum() > 1) continue;
        Eigen::Vector4f weights = Eigen::Vector4f::Zero();
        weights[static_cast<Index>(triangle[0])] = static_cast<float>(1 - share.sum());
        weights[static_cast<Index>(triangle[1])] = static_cast<float>(share.x());
        weights[static_cast<Index>(triangle[2])] = static_cast<float>(share.y());
        passing[p] *= 1 - double{surface.opacity(q, weights, 0)};
      }
    }
  }
  double sum = 0;
  for (const double light : passing) sum += light;
  return 1 - sum / static_cast<double>(points.size());
}

}  // namespace crowdface
