// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/skin_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/core/selection.h"
#include "crowdface/core/smooth_step.h"
#include "head_models/synth/complexion.h"

namespace crowdface::synth {
namespace {

bool is_skin(const AtlasTexel& place) {
  return place.is_covered && place.on_eyeball <= 0.5;
}

/// Computes the slopes of a height field that is stored in texels; between two texels that are not
/// adjacent on the skin, the slope is 0.
class Slopes {
 public:
  Slopes(const std::vector<AtlasTexel>& atlas, const std::vector<double>& heights, double texel)
      : atlas_(atlas), heights_(heights), farthest_(4 * texel) {}

  /// Returns the slope at `middle` between its neighbours `a` and `b`. At a border of the skin,
  /// returns the one-sided difference.
  double across(std::size_t a, std::size_t middle, std::size_t b) const {
    const std::size_t from = joined(a, middle) ? a : middle;
    const std::size_t to = joined(middle, b) ? b : middle;
    if (from == to) return 0;
    const double length = distance(from, to);
    return length > 0 ? (heights_[to] - heights_[from]) / length : 0;
  }

 private:
  double distance(std::size_t a, std::size_t b) const {
    return (atlas_[a].skin.position - atlas_[b].skin.position).norm();
  }
  bool joined(std::size_t a, std::size_t b) const {
    return is_skin(atlas_[a]) && is_skin(atlas_[b]) && distance(a, b) < farthest_;
  }

  const std::vector<AtlasTexel>& atlas_;
  const std::vector<double>& heights_;
  double farthest_;
};

}  // namespace

double texel_cm(int size, const std::vector<AtlasTexel>& atlas) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < atlas.size(); ++i) {
    if (i % static_cast<std::size_t>(size) == 0 || !is_skin(atlas[i]) || !is_skin(atlas[i - 1])) {
      continue;
    }
    steps.push_back((atlas[i].skin.position - atlas[i - 1].skin.position).norm());
  }
  if (steps.empty()) return 1;
  const std::size_t middle = steps.size() / 2;
  return nth_smallest(std::move(steps), middle);
}

std::vector<std::uint8_t> skin_normals(int size, const std::vector<AtlasTexel>& atlas,
                                       double texel_size_cm, const Relief& relief) {
  std::vector<double> heights(atlas.size());
  for_each_texel(size, [&](std::size_t i) {
    if (is_skin(atlas[i])) heights[i] = relief.height(atlas[i].skin);
  });
  const Slopes slopes(atlas, heights, texel_size_cm);
  const auto side = static_cast<std::size_t>(size);
  std::vector<std::uint8_t> bytes(3 * atlas.size());
  for_each_texel(size, [&](std::size_t i) {
    const std::size_t x = i % side, y = i / side;
    const std::size_t left = x > 0 ? i - 1 : i, right = x + 1 < side ? i + 1 : i;
    const std::size_t above = y > 0 ? i - side : i, below = y + 1 < side ? i + side : i;
    const Eigen::Vector3d normal =
        Eigen::Vector3d(-slopes.across(left, i, right), -slopes.across(below, i, above), 1)
            .normalized();
    for (std::size_t c = 0; c < 3; ++c) {
      bytes[3 * i + c] = to_byte((normal[static_cast<Eigen::Index>(c)] + 1) / 2);
    }
  });
  return bytes;
}

double skin_roughness(const AtlasTexel& place, double on_lips, double hair, double aged) {
  if (place.on_eyeball > 0.5) return 0.08;
  const Eigen::Vector3d& p = place.skin.position;
  const double front = smooth_step(4, 7, p.z());
  const double nose = smooth_step(2.2, 0.8, std::abs(p.x())) * smooth_step(-5.5, -4, p.y()) *
                      smooth_step(2, 0.5, p.y());
  const double forehead =
      smooth_step(5, 2, std::abs(p.x())) * smooth_step(2.5, 4, p.y()) * smooth_step(7.5, 6, p.y());
  const double cheekbone = smooth_step(
      2.6, 1, (Eigen::Vector2d(std::abs(p.x()), p.y()) - Eigen::Vector2d(4.2, -1.9)).norm());
  const double chin = smooth_step(2.2, 0.8, Eigen::Vector2d(p.x(), p.y() + 10).norm());
  double roughness = 0.58 + 0.08 * std::clamp(aged, 0.0, 1.0);
  roughness -= front * (0.14 * nose + 0.09 * forehead + 0.03 * cheekbone + 0.07 * chin);
  // The lower lip is moist. The upper lip is drier, so that no light rim shows at its edge.
  roughness += on_lips * ((p.y() < -7 ? 0.33 : 0.46) - roughness);
  // The inner edges of the lids are moist.
  roughness += smooth_step(1.05, 1.15, place.eye_ring_coordinate) * (0.15 - roughness);
  return roughness + hair * (0.8 - roughness);
}

}  // namespace crowdface::synth
