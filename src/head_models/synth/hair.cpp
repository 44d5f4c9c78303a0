// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/hair.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/interpolate_knots.h"
#include "crowdface/core/random.h"
#include "crowdface/core/smooth_step.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Position around the head: 0 at the front, 1 at the side, 2 at the back.
double around_head(const Vector3d& p) {
  const double x = std::abs(p.x()), z = std::abs(p.z());
  const double quarter = x / std::max(x + z, 1e-9);
  return p.z() >= 0 ? quarter : 2 - quarter;
}

/// Returns 0 on the ears. The value rises to 1 at a distance of `away` ear sizes from the ears'
/// centres, and stays 1 beyond.
double off_ears(const Vector3d& p, double away) {
  const double y = (p.y() + 2.6) / 4.6, z = (p.z() + 1.6) / 3.4;
  const double beside = smooth_step(4.5, 6, std::abs(p.x()));
  return 1 - beside * smooth_step(away, 0.95, std::sqrt(y * y + z * z));
}

HairStyle random_hair_style(std::uint64_t seed, std::uint64_t index) {
  const Person person = random_person(seed, index);
  const Complexion look = random_complexion(seed, index);
  const auto unit = [&](const char* purpose) { return random_uniform({seed, index, purpose}); };
  const double kind = random_stratified({seed, index / 2, "synth/hair_style"}, 4);
  HairStyle style;
  style.curliness = smooth_step(0.35, 0.9, 0.75 * look.skin_tone + 0.5 * unit("synth/curls"));
  style.extra_volume_to_side =
      (unit("synth/hair_lean") < 0.5 ? -1 : 1) * 0.6 * unit("synth/hair_part");
  if (person.maleness > 0) {
    style.top_thickness = kind < 0.3 ? 0.35 : kind < 0.75 ? 1.3 : 2.0;
    style.side_thickness = kind < 0.75 ? 0.3 : 0.7;
    return style;
  }
  style.has_low_hairline = true;
  style.top_thickness = 1.0;
  style.side_thickness = 0.8;
  if (kind < 0.5 && person.age_years < 60) {
    style.nape_length = 3;
  } else if (kind < 0.75) {
    style.bun_height = 2.0;
    style.top_thickness = style.side_thickness = 0.5;
  } else {
    style.top_thickness = 2.2;
    style.side_thickness = 1.5;
  }
  return style;
}

}  // namespace

bool has_curls(std::uint64_t seed, std::uint64_t index) {
  return random_hair_style(seed, index).curliness > 0.5;
}

Hair::Hair(std::uint64_t seed, std::uint64_t index, bool includes_hanging_hair)
    : style_(random_hair_style(seed, index)),
      recession_(random_complexion(seed, index).recession),
      hairs_(mix(seed, index, 106), 0.045),
      tufts_(mix(seed, index, 107), 0.3),
      edge_(mix(seed, index, 108), 0.5),
      locks_(mix(seed, index, 109), 0.55) {
  if (!includes_hanging_hair) style_.nape_length = 0;
}

double Hair::strand_brightness(const Vector3d& p) const {
  // Straight hair is noise stretched into strands from the face to the back; curls are isotropic
  // noise.
  const double across = p.x() / (p - Vector3d(0, -4, -4)).norm();
  const double straight = hairs_.at({9 * across, 0.05 * p.y(), 0.05 * p.z()}) +
                          0.6 * tufts_.at({13 * across, 0.04 * p.y(), 0.04 * p.z()});
  if (style_.curliness == 0) return straight;
  const double curled = 0.6 * hairs_.at(p) + 0.6 * tufts_.at(p);
  return straight + style_.curliness * (curled - straight);
}

double Hair::hanging_fraction(const Vector3d& p) const {
  if (style_.nape_length <= 0) return 0;
  return smooth_step(1.18, 1.5, around_head(p)) * smooth_step(-1, -10, p.y());
}

double height_above_hairline(const Vector3d& p, bool has_low_hairline, double recession) {
  // clang-format off
  const std::array<Vector2d, 9> high = {{
      {0.0, 7.6 + 3.2 * recession}, {0.25, 7.5 + 4.2 * recession}, {0.42, 6.6 + 3.0 * recession},
      {0.55, 5.0 + 0.6 * recession}, {0.68, 1.6}, {0.80, 0.6}, {0.92, 2.4}, {1.15, 2.0}, {1.35, -6.0}}};
  static const std::array<Vector2d, 8> low = {{
      {0.0, 7.4}, {0.25, 7.0}, {0.42, 5.8}, {0.55, 3.6}, {0.68, 1.0}, {0.80, 0.2}, {0.92, 2.4}, {1.35, -7.5}}};
  // clang-format on
  const double around = around_head(p);
  return p.y() -
         (has_low_hairline ? interpolate_knots(low, around) : interpolate_knots(high, around));
}

double Hair::density_after_balding(const Vector3d& p) const {
  const double crown = smooth_step(6.5, 11.5, p.y()) * smooth_step(-9, -4, p.z());
  return 1 - smooth_step(0.45, 0.9, recession_) * crown;
}

bool Hair::may_cover(const Vector3d& p) const {
  return height_above_style_hairline(p) > -1 || hanging_fraction(p) > 0;
}

double Hair::coverage(const Vector3d& p, double strand_brightness) const {
  const double frayed = height_above_style_hairline(p) + 0.25 * edge_.at(p) +
                        (style_.has_low_hairline ? 0.15 : 0.25) * strand_brightness;
  const double edge = smooth_step(-0.2, style_.has_low_hairline ? 0.6 : 1.0, frayed);
  return std::max(edge * density_after_balding(p), smooth_step(0.02, 0.2, hanging_fraction(p)));
}

double Hair::thickness(const Vector3d& p) const {
  const double rise = smooth_step(-0.2, 2.4, height_above_style_hairline(p)) *
                      density_after_balding(p) * (1 - 0.6 * recession_);
  const double top = smooth_step(5.5, 10.5, p.y());
  const double fuller = 1 + style_.extra_volume_to_side * p.x() / (3 + std::abs(p.x()));
  const double curl = 1 + style_.curliness * 0.22 * locks_.at(p);
  double thick =
      rise * curl *
      (top * fuller * style_.top_thickness + (1 - top) * off_ears(p, 1.6) * style_.side_thickness);
  // The bun.
  const double knot = (p - Vector3d(0, 11.5, -3.5)).norm();
  thick += style_.bun_height * smooth_step(3.2, 1.2, knot);
  // Hanging locks: noise stretched along y.
  const double wave = 1 + 0.12 * locks_.at({p.x(), 0.1 * p.y(), p.z()});
  return thick + style_.nape_length * hanging_fraction(p) * off_ears(p, 1.6) * wave;
}

}  // namespace crowdface::synth
