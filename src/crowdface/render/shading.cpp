// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace crowdface {
namespace {

struct Material {
  Light albedo;
  Light wrap;         ///< how far light reaches past the shadow's edge, as a cosine
  float roughness;    ///< of the microfacets, 0 a mirror
  float reflectance;  ///< at normal incidence
};

Material material_of(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::kEye:
      return {{0.66F, 0.63F, 0.60F}, {0.15F, 0.12F, 0.10F}, 0.16F, 0.04F};
    case SurfaceKind::kIris:
      return {{0.075F, 0.052F, 0.040F}, {0.05F, 0.05F, 0.05F}, 0.14F, 0.04F};
    case SurfaceKind::kTeeth:
      return {{0.68F, 0.62F, 0.52F}, {0.15F, 0.12F, 0.10F}, 0.25F, 0.04F};
    case SurfaceKind::kGums:
      return {{0.42F, 0.20F, 0.18F}, {0.20F, 0.10F, 0.08F}, 0.30F, 0.04F};
    case SurfaceKind::kWorn:
      return {{0.5F, 0.5F, 0.5F}, {0.30F, 0.28F, 0.26F}, 0.45F, 0.03F};
    case SurfaceKind::kSkin:
    case SurfaceKind::kHidden:
      break;
  }
  return {{0.47F, 0.385F, 0.335F}, {0.30F, 0.19F, 0.14F}, 0.48F, 0.03F};
}

struct Lamp {
  Eigen::Vector3f direction;  ///< towards it, unit
  Light colour;
};

struct Studio {
  Lamp key, fill, rim_right, rim_left;
  Light sky_above, sky_below;
};

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

/// Diffuse light with the terminator moved to a cosine of −wrap: the mean of a linear and a quadratic
/// fall-off, in all five sixths of Lambert's light whatever the wrap.
Light wrapped(float cosine, const Light& wrap) {
  const Light lit = ((cosine + wrap) / (1 + wrap)).max(0.0F);
  return lit * lit / (1 + wrap).square() * (1 + wrap) * 0.5F + lit / (1 + wrap) * 0.5F;
}

/// Microfacet reflection (GGX distribution, Walter et al. 2007; Schlick's Fresnel) times the
/// cosine.
float highlight(const Eigen::Vector3f& normal, const Eigen::Vector3f& to_eye,
                const Eigen::Vector3f& to_light, const Material& material) {
  const float n_l = normal.dot(to_light);
  const float n_v = std::max(normal.dot(to_eye), 0.05F);
  if (n_l <= 0) return 0;
  const Eigen::Vector3f half = (to_light + to_eye).normalized();
  const float n_h = std::max(normal.dot(half), 0.0F);
  const float v_h = std::max(to_eye.dot(half), 0.0F);
  const float alpha = material.roughness * material.roughness;
  const float a2 = alpha * alpha;
  const float spread = n_h * n_h * (a2 - 1) + 1;
  const float facets = a2 / (std::numbers::pi_v<float> * spread * spread);
  const float away = 1 - v_h;
  const float fresnel =
      material.reflectance + (1 - material.reflectance) * away * away * away * away * away;
  const float shadowing = n_l + std::sqrt(a2 + (1 - a2) * n_l * n_l);
  const float masking = n_v + std::sqrt(a2 + (1 - a2) * n_v * n_v);
  return n_l * facets * fresnel / (shadowing * masking) * std::numbers::pi_v<float>;
}

/// Lamps are points: what is smoother than this would show nothing of them but dots.
constexpr float kLeastRoughness = 0.14F;

/// What is darker than any skin is painted hair, which scatters what falls on it.
float dark_gleam(const Light& albedo) {
  constexpr float kDarkestSkin = 0.055F;
  return std::clamp(albedo.mean() / kDarkestSkin, 0.25F, 1.0F);
}

/// Light that bounces inside a crevice is not lost: it comes out in the surface's colour (fit by
/// Jimenez et al. 2016, "Practical realtime strategies for accurate indirect occlusion").
Light with_bounces(float visible, const Light& albedo) {
  const Light a = 2.0404F * albedo - 0.3324F;
  const Light b = -4.7951F * albedo + 0.6417F;
  const Light c = 2.7552F * albedo + 0.6903F;
  return (((visible * a + b) * visible + c) * visible).max(visible).min(1.0F);
}

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

}  // namespace

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
  const Studio& lamps = studio();
  Material material = material_of(point.kind);
  if (point.roughness >= 0) {
    material.roughness = std::clamp(point.roughness, kLeastRoughness, 1.0F);
  }
  if (point.kind == SurfaceKind::kSkin || point.kind == SurfaceKind::kWorn) {
    material.reflectance *= dark_gleam(point.albedo);
  }
  const Eigen::Vector3f& n = point.normal;
  const Light open = with_bounces(point.sky, point.albedo);

  Light diffuse = lamps.key.colour * wrapped(n.dot(lamps.key.direction), material.wrap) * point.key;
  diffuse += lamps.fill.colour * wrapped(n.dot(lamps.fill.direction), material.wrap) * open;
  diffuse += lamps.rim_right.colour * std::max(n.dot(lamps.rim_right.direction), 0.0F) * point.sky;
  diffuse += lamps.rim_left.colour * std::max(n.dot(lamps.rim_left.direction), 0.0F) * point.sky;
  diffuse += (lamps.sky_below + (lamps.sky_above - lamps.sky_below) * (0.5F + 0.5F * n.y())) * open;

  Light gloss =
      lamps.key.colour * highlight(n, point.to_eye, lamps.key.direction, material) * point.key;
  const float soft = point.sky * point.sky;
  gloss += lamps.fill.colour * highlight(n, point.to_eye, lamps.fill.direction, material) * soft;
  gloss += lamps.rim_right.colour *
           highlight(n, point.to_eye, lamps.rim_right.direction, material) * soft;
  gloss +=
      lamps.rim_left.colour * highlight(n, point.to_eye, lamps.rim_left.direction, material) * soft;

  if (point.kind == SurfaceKind::kWorn)
    gleam *= 0.45F;  // mostly hair, which lies in all directions
  const Light light = point.albedo * diffuse + gleam * gloss;
  return point.inside ? Light(light * 0.3F) : light;
}

Light background(float y) {
  return Light(0.23F, 0.235F, 0.245F) * (1 - 0.48F * y);
}

std::array<std::uint8_t, 3> to_srgb8(const Light& light) {
  std::array<std::uint8_t, 3> out;
  for (int c = 0; c < 3; ++c) {
    out[static_cast<std::size_t>(c)] =
        static_cast<std::uint8_t>(std::lround(255 * encode_srgb(soft_shoulder(light[c]))));
  }
  return out;
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
