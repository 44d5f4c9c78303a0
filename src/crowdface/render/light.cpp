// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

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
int find_byte(float light) {
  return static_cast<int>(std::lround(255 * encode_srgb(soft_shoulder(light))));
}

/// Lookup table for the results of find_byte. find_byte itself is slow because it calls std::pow.
class ByteTable {
 public:
  ByteTable() {
    // For each byte, find by bisection the smallest float that maps to it. The bit patterns of
    // positive floats have the same order as their values.
    for (int byte = 1; byte < 256; ++byte) {
      std::uint32_t below = 0, first = std::bit_cast<std::uint32_t>(kWhite);
      while (first - below > 1) {
        const std::uint32_t middle = below + (first - below) / 2;
        (find_byte(std::bit_cast<float>(middle)) < byte ? below : first) = middle;
      }
      smallest_of_byte_[static_cast<std::size_t>(byte)] = std::bit_cast<float>(first);
    }
    smallest_of_byte_[256] = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < kSteps; ++i) {
      at_step_[i] = static_cast<std::uint8_t>(
          find_byte(static_cast<float>(i) * (kWhite / static_cast<float>(kSteps))));
    }
  }
  std::uint8_t at(float light) const {
    const float inside = std::clamp(light, 0.0F, kWhite);
    const auto step = static_cast<std::size_t>(inside * (static_cast<float>(kSteps) / kWhite));
    std::size_t byte = at_step_[std::min(step, kSteps - 1)];
    while (inside >= smallest_of_byte_[byte + 1]) ++byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  /// this linear value and all larger values map to the byte 255
  static constexpr float kWhite = 1.5F;
  static constexpr std::size_t kSteps = 6144;
  /// for each byte: the smallest linear value that maps to it
  std::array<float, 257> smallest_of_byte_{};
  std::array<std::uint8_t, kSteps> at_step_{};
};

}  // namespace

std::array<std::uint8_t, 3> to_srgb8(const LinearRgb& light) {
  static const ByteTable bytes;
  return {bytes.at(light[0]), bytes.at(light[1]), bytes.at(light[2])};
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
