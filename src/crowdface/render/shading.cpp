// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/shading.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "crowdface/render/shade_batch.h"
#include "crowdface/render/studio.h"

namespace crowdface {
namespace {

float encode_srgb(float linear) {
  if (linear <= 0.0031308F) return 12.92F * std::max(linear, 0.0F);
  return 1.055F * std::pow(std::min(linear, 1.0F), 1 / 2.4F) - 0.055F;
}

/// Leaves the darker half as it is and bends the brighter half so that nothing burns out.
float soft_shoulder(float x) {
  constexpr float kKnee = 0.6F;
  if (x <= kKnee) return x;
  const float over = (x - kKnee) / (1 - kKnee);
  return kKnee + (1 - kKnee) * over / (1 + 0.55F * over);
}

/// The byte that a screen shows of a light.
int find_byte(float light) {
  return static_cast<int>(std::lround(255 * encode_srgb(soft_shoulder(light))));
}

/// The bytes of all lights, for looking up: `find_byte` takes two logarithms.
class ByteTable {
 public:
  ByteTable() {
    // From the bits of floats above 0, which stand in their order, the first that shows a byte.
    for (int byte = 1; byte < 256; ++byte) {
      std::uint32_t below = 0, first = std::bit_cast<std::uint32_t>(kWhite);
      while (first - below > 1) {
        const std::uint32_t middle = below + (first - below) / 2;
        (find_byte(std::bit_cast<float>(middle)) < byte ? below : first) = middle;
      }
      first_of_[static_cast<std::size_t>(byte)] = std::bit_cast<float>(first);
    }
    first_of_[256] = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < kSteps; ++i) {
      at_step_[i] = static_cast<std::uint8_t>(
          find_byte(static_cast<float>(i) * (kWhite / static_cast<float>(kSteps))));
    }
  }
  std::uint8_t at(float light) const {
    const float inside = std::clamp(light, 0.0F, kWhite);
    const auto step = static_cast<std::size_t>(inside * (static_cast<float>(kSteps) / kWhite));
    std::size_t byte = at_step_[std::min(step, kSteps - 1)];
    while (inside >= first_of_[byte + 1]) ++byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  static constexpr float kWhite = 1.5F;  ///< and all above it
  static constexpr std::size_t kSteps = 6144;
  std::array<float, 257> first_of_{};  ///< lights that show the byte
  std::array<std::uint8_t, kSteps> at_step_{};
};

}  // namespace

const Material& material_of(SurfaceKind kind) {
  struct Materials {
    Material skin, eye, iris, teeth, gums, worn;
  };
  static const Materials materials = {
      .skin = {{0.47F, 0.385F, 0.335F}, {0.30F, 0.19F, 0.14F}, 0.48F, 0.03F},
      .eye = {{0.66F, 0.63F, 0.60F}, {0.15F, 0.12F, 0.10F}, 0.16F, 0.04F},
      .iris = {{0.075F, 0.052F, 0.040F}, {0.05F, 0.05F, 0.05F}, 0.14F, 0.04F},
      .teeth = {{0.68F, 0.62F, 0.52F}, {0.15F, 0.12F, 0.10F}, 0.25F, 0.04F},
      .gums = {{0.42F, 0.20F, 0.18F}, {0.20F, 0.10F, 0.08F}, 0.30F, 0.04F},
      .worn = {{0.5F, 0.5F, 0.5F}, {0.30F, 0.28F, 0.26F}, 0.45F, 0.03F}};
  switch (kind) {
    case SurfaceKind::kEye:
      return materials.eye;
    case SurfaceKind::kIris:
      return materials.iris;
    case SurfaceKind::kTeeth:
      return materials.teeth;
    case SurfaceKind::kGums:
      return materials.gums;
    case SurfaceKind::kWorn:
      return materials.worn;
    case SurfaceKind::kSkin:
    case SurfaceKind::kHidden:
      break;
  }
  return materials.skin;
}

const Studio& studio() {
  static const Studio lamps = {
      .key = {Eigen::Vector3f(-0.62F, 0.62F, 0.62F).normalized(), {1.55F, 1.49F, 1.39F}},
      .fill = {Eigen::Vector3f(0.85F, 0.05F, 0.55F).normalized(), {0.15F, 0.165F, 0.185F}},
      .rim_right = {Eigen::Vector3f(0.80F, 0.35F, -0.50F).normalized(), {0.62F, 0.65F, 0.71F}},
      .rim_left = {Eigen::Vector3f(-0.85F, 0.25F, -0.55F).normalized(), {0.25F, 0.26F, 0.28F}},
      .sky_above = {0.29F, 0.30F, 0.315F},
      .sky_below = {0.10F, 0.093F, 0.086F}};
  return lamps;
}

Light albedo_of(SurfaceKind kind) {
  return material_of(kind).albedo;
}

Eigen::Vector3f key_direction() {
  return studio().key.direction;
}

bool faces_key(const ShadePoint& point) {
  const float cosine = point.normal.dot(studio().key.direction);
  return cosine > -material_of(point.kind).wrap.maxCoeff();
}

Light shade(const ShadePoint& point, float gleam) {
  ShadeBatch alone;
  alone.add(point, gleam);
  alone.shade();
  return alone.light(0);
}

Light background(float y) {
  return Light(0.23F, 0.235F, 0.245F) * (1 - 0.48F * y);
}

std::array<std::uint8_t, 3> to_srgb8(const Light& light) {
  static const ByteTable bytes;
  return {bytes.at(light[0]), bytes.at(light[1]), bytes.at(light[2])};
}

Eigen::Array3f to_srgb(const Light& colour) {
  return colour.unaryExpr([](float value) { return encode_srgb(value); });
}

Light from_srgb(const Eigen::Array3f& srgb) {
  return srgb.unaryExpr([](float value) {
    return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
  });
}

const std::array<float, 256>& light_of_srgb8() {
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
