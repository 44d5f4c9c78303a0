// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/landmark_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/io/image.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/render/contact_sheet.h"
#include "crowdface/render/text_label.h"

namespace crowdface {
namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour kDot = {255, 214, 64}, kRim = {20, 20, 22};
/// smallest cosine between normal and camera direction at which dots are drawn
constexpr double kTurnedAway = 0.08;

struct Pixel {
  double x, y;
};

/// The pixel at which a camera shows a point.
Pixel project(const Camera& camera, const Eigen::Vector3d& point, int width) {
  const Eigen::Vector3d away = point - camera.target;
  const double depth = camera.distance - away.dot(camera.back);
  const double scale = width / 2.0 / (depth * camera.tan_half_fov);
  return {width / 2.0 + away.dot(camera.right) * scale, width / 2.0 - away.dot(camera.up) * scale};
}

void draw_dot(const Pixel& at, double radius, Rgb8Image& image) {
  const auto around = static_cast<int>(std::ceil(radius + 1.5));
  const int column = static_cast<int>(at.x), row = static_cast<int>(at.y);
  for (int y = row - around; y <= row + around; ++y) {
    for (int x = column - around; x <= column + around; ++x) {
      const double away = std::hypot(x + 0.5 - at.x, y + 0.5 - at.y);
      if (x < 0 || y < 0 || x >= image.width || y >= image.height || away > radius + 1) continue;
      const Colour& colour = away <= radius ? kDot : kRim;
      std::copy(colour.begin(), colour.end(), image.at(x, y));
    }
  }
}

void draw_label(const std::string& label, const Pixel& at, Rgb8Image& image) {
  constexpr int kHeight = 15, kPerLetter = 9, kBeside = 6;
  const Rgb8Image text =
      label_strip(label, kPerLetter * static_cast<int>(label.size()) + 4, kHeight,
                  {.text_px = 12, .text_colour = {255, 255, 255}, .background_colour = kRim});
  const int left = std::clamp(static_cast<int>(at.x) + kBeside, 0, image.width - text.width);
  const int top = std::clamp(static_cast<int>(at.y) - kHeight / 2, 0, image.height - kHeight);
  for (int y = 0; y < text.height; ++y) {
    for (int x = 0; x < text.width; ++x) {
      const std::uint8_t* from = text.at(x, y);
      if (from[0] == kRim[0] && from[1] == kRim[1] && from[2] == kRim[2]) continue;
      std::copy_n(from, 3, image.at(left + x, top + y));
    }
  }
}

}  // namespace

std::string landmark_picture(const CrowdRenders& renders, const Topology& topology,
                             const Positions& head, const std::vector<LabelledPoint>& points) {
  std::vector<Rgb8Image> views;
  const Positions normals = vertex_normals(topology, head);
  for (const Camera& camera : renders.cameras()) {
    Rgb8Image& image = views.emplace_back(renders.render(head, camera));
    for (const LabelledPoint& labelled : points) {
      const SurfacePoint& surface_point = labelled.surface_point;
      const Eigen::Vector3d point =
          point_on(head, surface_point.corners, surface_point.barycentric);
      const Eigen::Vector3d to_camera = (camera.position() - point).normalized();
      const Eigen::Vector3d normal =
          point_on(normals, surface_point.corners, surface_point.barycentric);
      if (normal.dot(to_camera) < kTurnedAway) continue;
      const Pixel at = project(camera, point, image.width);
      draw_dot(at, image.width / 250.0, image);
      draw_label(labelled.label, at, image);
    }
  }
  const Rgb8Image image = joined_pictures(views);
  return encode_png(image.width, image.height, 3, image.pixels);
}

}  // namespace crowdface
