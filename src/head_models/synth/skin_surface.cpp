// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/skin_surface.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/smooth_step.h"
#include "head_models/synth/complexion.h"

namespace crowdface::synth {
namespace {

/// A point of the relief that one texel shows.
struct ReliefTexel {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the average head, cm
  double height = 0;                                   ///< of the relief, cm
  bool is_skin = false;  ///< false on eyeballs and where the texture shows no surface
};

/// Computes slopes of the relief between texels.
/// \param farthest  distance in cm. If the points that two texels show are at least this far apart,
///                  they are not adjacent on the skin, even if the texels are neighbours.
class Slopes {
 public:
  explicit Slopes(double farthest) : farthest_(farthest) {}

  /// Returns the slope at `middle` between its neighbours `a` and `b`. At a border of the skin,
  /// returns the one-sided difference.
  double across(const ReliefTexel& a, const ReliefTexel& middle, const ReliefTexel& b) const {
    const ReliefTexel& from = joined(a, middle) ? a : middle;
    const ReliefTexel& to = joined(middle, b) ? b : middle;
    const double length = distance(from, to);
    return length > 0 ? (to.height - from.height) / length : 0;
  }

 private:
  static double distance(const ReliefTexel& a, const ReliefTexel& b) {
    return (a.position - b.position).norm();
  }
  bool joined(const ReliefTexel& a, const ReliefTexel& b) const {
    return a.is_skin && b.is_skin && distance(a, b) < farthest_;
  }

  double farthest_;
};

}  // namespace

double texel_cm(const SkinAtlas& atlas) {
  std::vector<std::vector<double>> steps_of_rows(atlas.side());
  parallel_for_each(atlas.side(), 16, [&](std::size_t row) {
    std::optional<Eigen::Vector3d> left;
    for (std::size_t i = row * atlas.side(); i < (row + 1) * atlas.side(); ++i) {
      std::optional<Eigen::Vector3d> here;
      if (atlas.is_covered(i)) {
        const AtlasTexel place = atlas[i];
        if (place.on_eyeball <= 0.5) here = place.skin.position;
      }
      if (left && here) steps_of_rows[row].push_back((*here - *left).norm());
      left = here;
    }
  });
  std::vector<double> steps;
  for (const std::vector<double>& row : steps_of_rows)
    steps.insert(steps.end(), row.begin(), row.end());
  if (steps.empty()) return 1;
  const std::size_t middle = steps.size() / 2;
  return nth_smallest(std::move(steps), middle);
}

std::vector<std::uint8_t> skin_normals(const SkinAtlas& atlas, double texel_size_cm,
                                       const Relief& relief) {
  const Slopes slopes(4 * texel_size_cm);
  const std::size_t side = atlas.side();
  std::vector<std::uint8_t> bytes(3 * atlas.size());
  for_each_square(side, [&](std::size_t left, std::size_t top, std::size_t right,
                            std::size_t bottom) {
    // Compute the relief of the square and of the texels around it.
    const std::size_t x0 = left > 0 ? left - 1 : 0, x1 = std::min(right + 1, side), width = x1 - x0;
    const std::size_t y0 = top > 0 ? top - 1 : 0, y1 = std::min(bottom + 1, side);
    std::vector<ReliefTexel> texels(width * (y1 - y0));
    for (std::size_t k = 0; k < texels.size(); ++k) {
      const std::size_t i = (y0 + k / width) * side + x0 + k % width;
      if (!atlas.is_covered(i)) continue;
      const AtlasTexel place = atlas[i];
      if (place.on_eyeball > 0.5) continue;
      texels[k] = {place.skin.position, relief.height(place.skin), true};
    }
    for (std::size_t y = top; y < bottom; ++y) {
      for (std::size_t x = left; x < right; ++x) {
        const auto texel = [&](std::size_t column, std::size_t row) -> const ReliefTexel& {
          return texels[(std::clamp(row, y0, y1 - 1) - y0) * width +
                        (std::clamp(column, x0, x1 - 1) - x0)];
        };
        const ReliefTexel& middle = texel(x, y);
        const double du = slopes.across(texel(x > 0 ? x - 1 : 0, y), middle, texel(x + 1, y));
        const double dv = slopes.across(texel(x, y + 1), middle, texel(x, y > 0 ? y - 1 : 0));
        const Eigen::Vector3d normal = Eigen::Vector3d(-du, -dv, 1).normalized();
        for (std::size_t c = 0; c < 3; ++c) {
          bytes[3 * (y * side + x) + c] = to_byte((normal[static_cast<Eigen::Index>(c)] + 1) / 2);
        }
      }
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
