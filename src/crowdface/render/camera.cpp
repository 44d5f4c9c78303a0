// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

double turn_degrees(View view) {
  switch (view) {
    case View::kFront:
      return 0;
    case View::kThreeQuarter:
      return 35;
    case View::kProfile:
      return 90;
    case View::kBack:
      return 180;
  }
  return 0;
}

/// Heads, not busts, stand in the middle of a picture: what lies higher than this share of all.
constexpr double kNeck = 0.45;

Camera aim(const HeadFrame& frame, View view, const FramingOptions& options) {
  require(frame.up.index != frame.front.index, "camera: up ", name_of(frame.up), ", front ",
          name_of(frame.front));
  const double radians = std::numbers::pi / 180;
  Camera camera;
  camera.half_tangent = std::tan(options.field_of_view_degrees / 2 * radians);
  camera.up = unit_vector(frame.up);
  const Eigen::Vector3d front = unit_vector(frame.front);
  const Eigen::Vector3d side = camera.up.cross(front);
  const double turn = turn_degrees(view) * radians;
  camera.back = std::cos(turn) * front + std::sin(turn) * side;
  camera.right = camera.up.cross(camera.back);
  return camera;
}

/// The furthest planes of a wedge that opens along one image axis: a point at offset x and depth z
/// (towards the camera) is inside a wedge of slope s, centre c and distance d exactly if
/// d ≥ z + |x − c|/s.
struct Wedge {
  double slope;
  double positive = -std::numeric_limits<double>::infinity();  ///< max of z + x/s
  double negative = -std::numeric_limits<double>::infinity();  ///< max of z − x/s

  void add(double x, double z) {
    positive = std::max(positive, z + x / slope);
    negative = std::max(negative, z - x / slope);
  }
  double centre() const { return slope * (positive - negative) / 2; }
  double distance_from(double c) const {
    return std::max(positive - c / slope, negative + c / slope);
  }
};

struct Heights {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  double at(double share) const { return low + share * (high - low); }
};

Heights heights_of(std::span<const Positions* const> heads, const Eigen::Vector3d& up) {
  Heights heights;
  for (const Positions* head : heads) {
    for (Index i = 0; i < head->rows(); ++i) {
      const double height = head->row(i).dot(up);
      if (!head->row(i).allFinite()) {
        throw InvalidInput(concat("a camera needs finite positions, vertex ", i + 1, " is not"));
      }
      heights.low = std::min(heights.low, height);
      heights.high = std::max(heights.high, height);
    }
  }
  return heights;
}

/// Extent of some vertices along the sides and to the front.
struct Slab {
  double left = std::numeric_limits<double>::infinity(), right = -left, front = -left, back = left;
  void add(double side, double ahead) {
    left = std::min(left, side);
    right = std::max(right, side);
    front = std::max(front, ahead);
    back = std::min(back, ahead);
  }
};

/// Whether a face ends in what a cut would take away, as masks and heads without a neck do: it reaches as far to the
/// front as what is above, and is no pair of shoulders.
bool cuts_a_chin(std::span<const Positions* const> heads, const HeadFrame& frame,
                 const Heights& heights, double cut_below) {
  constexpr double kFaceEnds = 0.4, kBehind = 0.1, kShoulders = 0.75;
  const Eigen::Vector3d up = unit_vector(frame.up), front = unit_vector(frame.front);
  const Eigen::Vector3d side = up.cross(front);
  const double cut = heights.at(cut_below), face = heights.at(kFaceEnds);
  Slab all, below, above;
  for (const Positions* head : heads) {
    for (Index i = 0; i < head->rows(); ++i) {
      const Eigen::Vector3d point = head->row(i);
      const double height = point.dot(up), at = point.dot(side), ahead = point.dot(front);
      all.add(at, ahead);
      if (height < cut) {
        below.add(at, ahead);
      } else if (height < face) {
        above.add(at, ahead);
      }
    }
  }
  if (above.front < above.back) return false;
  return below.right - below.left < kShoulders * (all.right - all.left) &&
         below.front > above.front - kBehind * (all.front - all.back);
}

}  // namespace

Camera fit_camera(std::span<const Positions* const> heads, const HeadFrame& frame, View view,
                  const FramingOptions& options) {
  Camera camera = aim(frame, view, options);
  const double slope = camera.half_tangent * (1 - 2 * options.margin);
  Wedge across{slope}, along{slope}, head_across{slope};
  const Heights heights = heights_of(heads, camera.up);
  const bool whole =
      options.cut_below == 0 || cuts_a_chin(heads, frame, heights, options.cut_below);
  const double lowest = heights.at(whole ? 0 : options.cut_below), neck = heights.at(kNeck);
  double nearest = -std::numeric_limits<double>::infinity();
  double furthest = std::numeric_limits<double>::infinity();
  for (const Positions* head : heads) {
    for (Index i = 0; i < head->rows(); ++i) {
      const Eigen::Vector3d point = head->row(i);
      const double z = point.dot(camera.back);
      nearest = std::max(nearest, z);
      furthest = std::min(furthest, z);
      const double height = point.dot(camera.up), x = point.dot(camera.right);
      if (height >= neck) head_across.add(x, z);
      if (height < lowest) continue;
      across.add(x, z);
      along.add(height, z);
    }
  }
  for (const Eigen::Vector3d& point : options.beside) {
    const double height = point.dot(camera.up), z = point.dot(camera.back);
    if (height < lowest) continue;
    across.add(point.dot(camera.right), z);
    along.add(height, z);
  }
  require(nearest >= furthest, "camera: no vertex to look at");
  // The target lies half-way through the heads, so that half_extent() is about a head's size.
  const double middle = (nearest + furthest) / 2;
  const double x = head_across.centre(), y = along.centre();
  camera.target = x * camera.right + y * camera.up + middle * camera.back;
  camera.distance = std::max(across.distance_from(x), along.distance_from(y)) - middle;
  if (camera.distance <= nearest - middle)
    camera.distance = nearest - middle + 1;  // a single point
  return camera;
}

std::vector<Camera> fit_cameras(std::span<const Positions* const> heads, const HeadFrame& frame,
                                std::span<const View> views, const FramingOptions& options) {
  std::vector<Camera> cameras;
  double distance = 0;
  for (const View view : views) {
    cameras.push_back(fit_camera(heads, frame, view, options));
    distance = std::max(distance, cameras.back().distance);
  }
  for (Camera& camera : cameras) camera.distance = distance;
  return cameras;
}

}  // namespace crowdface
