// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

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

/// Vertices above this fraction of the mesh's height belong to the head. Only these vertices
/// determine the centre of the image, so that shoulders do not shift the centre.
constexpr double kNeck = 0.45;

Camera aim(const HeadFrame& frame, View view, const FramingOptions& options) {
  require(frame.up.index != frame.front.index, "camera: expected different axes, found up ",
          name_of(frame.up), " and front ", name_of(frame.front));
  const double radians = std::numbers::pi / 180;
  Camera camera;
  camera.tan_half_fov = std::tan(options.field_of_view_degrees / 2 * radians);
  camera.up = unit_vector(frame.up);
  const Eigen::Vector3d front = unit_vector(frame.front);
  const Eigen::Vector3d side = camera.up.cross(front);
  const double turn = turn_degrees(view) * radians;
  camera.back = std::cos(turn) * front + std::sin(turn) * side;
  camera.right = camera.up.cross(camera.back);
  return camera;
}

/// The field of view of the camera in one image direction: a wedge of fixed slope that contains all
/// added points, at the smallest distance of the camera. A point at offset x and depth z (towards
/// the camera) is inside a wedge with slope s, centre c and distance d if d ≥ z + |x − c|/s.
struct Wedge {
  double slope;
  /// Maxima of z + x/slope and of z − x/slope over the added points. Each maximum determines one of
  /// the two boundary lines of the wedge.
  double max_z_plus_x = -std::numeric_limits<double>::infinity();
  double max_z_minus_x = -std::numeric_limits<double>::infinity();

  void add(double x, double z) {
    max_z_plus_x = std::max(max_z_plus_x, z + x / slope);
    max_z_minus_x = std::max(max_z_minus_x, z - x / slope);
  }
  double centre() const { return slope * (max_z_plus_x - max_z_minus_x) / 2; }
  double distance_from(double c) const {
    return std::max(max_z_plus_x - c / slope, max_z_minus_x + c / slope);
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
        throw InvalidInput(concat("a camera needs finite positions, but that of vertex ", i + 1,
                                  " is not finite"));
      }
      heights.low = std::min(heights.low, height);
      heights.high = std::max(heights.high, height);
    }
  }
  return heights;
}

/// Returns the height of the throat: the highest horizontal slice below the tip of the nose in
/// which the surface lies at least a quarter of the head's width behind the tip. A chin is never
/// that far behind the tip.
/// \return nothing if the mesh shows no throat, for example a mask or a head that ends at its chin.
std::optional<double> throat_of(const Positions& head, const HeadFrame& frame) {
  constexpr std::size_t kSlices = 32, kLowestNose = 9;
  constexpr double kBehind = 0.25;
  const Eigen::Vector3d up = unit_vector(frame.up), front = unit_vector(frame.front);
  const Eigen::Vector3d side = up.cross(front);
  const Positions* const one[] = {&head};
  const Heights heights = heights_of(one, up);
  if (!(heights.high > heights.low)) return std::nullopt;
  const double scale = kSlices / (heights.high - heights.low);
  const auto slice_of = [&](double height) {
    return std::min(kSlices - 1, static_cast<std::size_t>((height - heights.low) * scale));
  };
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  // For each horizontal slice of the head: the largest coordinate of the slice's points along
  // `front`, the direction in which the face looks.
  std::array<double, kSlices> ahead;
  ahead.fill(kNone);
  for (Index i = 0; i < head.rows(); ++i) {
    double& slice = ahead[slice_of(head.row(i).dot(up))];
    slice = std::max(slice, head.row(i).dot(front));
  }
  // The slice that contains the tip of the nose. The lowest slices are not searched, because the
  // chest of a bust may protrude farther than the nose.
  const auto nose = static_cast<std::size_t>(
      std::max_element(ahead.begin() + kLowestNose, ahead.end()) - ahead.begin());
  // Find the left and right ends of the head. Use only the nose's slice and all slices above,
  // because shoulders are wider than the head.
  double left = -kNone, right = kNone;
  for (Index i = 0; i < head.rows(); ++i) {
    if (slice_of(head.row(i).dot(up)) < nose) continue;
    left = std::min(left, head.row(i).dot(side));
    right = std::max(right, head.row(i).dot(side));
  }
  // Search downwards from the nose.
  for (std::size_t s = nose; s-- > 0;) {
    // Take the foremost of three slices, because on a coarse mesh a slice may have no vertex on the
    // midline.
    const double nearest = std::max({ahead[s], ahead[s + 1], s > 0 ? ahead[s - 1] : kNone});
    if (nearest != kNone && nearest < ahead[nose] - kBehind * (right - left)) {
      return heights.low + static_cast<double>(s) / scale;
    }
  }
  return std::nullopt;
}

/// The height of the lowest point that must be visible: necks and shoulders may lie outside the
/// image, but chins may not.
double lowest_shown(std::span<const Positions* const> heads, const HeadFrame& frame,
                    const Heights& heights, double bottom_cut_fraction) {
  double lowest = heights.at(bottom_cut_fraction);
  if (bottom_cut_fraction == 0) return lowest;
  for (const Positions* head : heads) {
    lowest = std::min(lowest, throat_of(*head, frame).value_or(heights.low));
  }
  return lowest;
}

}  // namespace

bool has_shoulders(const Positions& head, const HeadFrame& frame, double lowest_fraction) {
  const Eigen::Vector3d up = unit_vector(frame.up), side = up.cross(unit_vector(frame.front));
  const Eigen::VectorXd heights = head * up;
  const double low = heights.minCoeff();
  const double limit = low + lowest_fraction * (heights.maxCoeff() - low);
  const double middle = (head * side).mean();
  double above = 0, below = 0;
  for (Index i = 0; i < head.rows(); ++i) {
    double& width = heights[i] < limit ? below : above;
    width = std::max(width, std::abs(head.row(i).dot(side) - middle));
  }
  return below > above;
}

Camera fit_camera(std::span<const Positions* const> heads, const HeadFrame& frame, View view,
                  const FramingOptions& options) {
  Camera camera = aim(frame, view, options);
  const double slope = camera.tan_half_fov * (1 - 2 * options.margin);
  Wedge across{slope}, along{slope}, head_across{slope};
  const Heights heights = heights_of(heads, camera.up);
  const double lowest = lowest_shown(heads, frame, heights, options.bottom_cut_fraction);
  const double neck = heights.at(kNeck);
  // For each image direction, find the smallest field of view (see Wedge) that contains all points
  // that must be visible.
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
  for (const Eigen::Vector3d& point : options.extra_points) {
    const double height = point.dot(camera.up), z = point.dot(camera.back);
    if (height < lowest) continue;
    across.add(point.dot(camera.right), z);
    along.add(height, z);
  }
  require(nearest >= furthest, "camera: no vertex to look at");
  // Put the point that the camera looks at half-way through the heads, so that half_extent() is
  // about the size of a head.
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
