// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/light.h"

#include <algorithm>
#include <cmath>

namespace crowdface {
namespace {

float encode_srgb(float linear) {
  if (linear <= 0.0031308F) return 12.92F * std::max(linear, 0.0F);
  return 1.055F * std::pow(std::min(linear, 1.0F), 1 / 2.4F) - 0.055F;
}

/// Tone curve: the identity up to kKnee; larger values are compressed so that highlights do not
/// clip.
float soft_shoulder(float x) {
  constexpr float kKnee = 0.6F;
  if (x <= kKnee) return x;
  const float over = (x - kKnee) / (1 - kKnee);
  return kKnee + (1 - kKnee) * over / (1 + 0.55F * over);
}

/// The 8-bit sRGB value of a linear value.
std::uint8_t srgb8(float light) {
  constexpr float kWhite = 1.5F;  // this value and all larger values become 255
  return static_cast<std::uint8_t>(
      std::lround(255 * encode_srgb(soft_shoulder(std::min(light, kWhite)))));
}

}  // namespace

std::array<std::uint8_t, 3> to_srgb8(const LinearRgb& light) {
  return {srgb8(light[0]), srgb8(light[1]), srgb8(light[2])};
}

Eigen::Array3f to_srgb(const LinearRgb& colour) {
  return colour.unaryExpr([](float value) { return encode_srgb(value); });
}

LinearRgb from_srgb(const Eigen::Array3f& srgb) {
  return srgb.unaryExpr([](float value) {
    return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
  });
}

const std::array<float, 256>& linear_of_srgb8() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> light{};
    for (std::size_t value = 0; value < light.size(); ++value) {
      light[value] = from_srgb(Eigen::Array3f::Constant(static_cast<float>(value) / 255))[0];
    }
    return light;
  }();
  return table;
}

}  // namespace crowdface
