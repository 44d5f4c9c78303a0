// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "crowdface/render/surface_kind.h"

namespace crowdface {

/// Light, linear, red green blue; 1 is white on the screen.
using Light = Eigen::Array3f;

/// A point of the surface in the camera's own axes: x right, y up, z towards the camera.
struct ShadePoint {
  Eigen::Vector3f normal;  ///< unit, on the side that is seen
  Eigen::Vector3f to_eye;  ///< unit
  Light albedo;
  SurfaceKind kind = SurfaceKind::kSkin;
  bool inside = false;   ///< the back of the surface is seen: nostrils, sockets
  float sky = 1;         ///< share of the ambient light that arrives
  float key = 1;         ///< share of the key light that arrives
  float roughness = -1;  ///< of its gloss, 0 … 1; below 0: what its kind has
};

/// What a surface of this kind reflects where no colour is given.
Light albedo_of(SurfaceKind kind);

/// A portrait studio that moves with the camera: a large key light from the upper left, a weak fill
/// from the right, two rims from behind and a sky. Skin scatters light past the shadow's edge, red
/// furthest (wrapped diffuse); the highlights are microfacet (Walter et al. 2007).
/// \param gleam  what part of its gloss the surface has.
Light shade(const ShadePoint& point, float gleam = 1);

/// Whether any light of the key comes off a surface that looks where this one does.
bool faces_key(const ShadePoint& point);

/// Towards the middle of the key light (unit), and the sine of its angular radius.
Eigen::Vector3f key_direction();
inline constexpr float kKeyRadius = 0.16F;

/// The backdrop, lighter on top; `y` from 0 (top) to 1.
Light background(float y);

/// As a screen shows it: sRGB's transfer curve, rounded to 8 bits.
std::array<std::uint8_t, 3> to_srgb8(const Light& light);
/// The same transfer curve alone: a colour of a surface as it is chosen on a screen.
Eigen::Array3f to_srgb(const Light& colour);
/// The inverse, for colours chosen on a screen; each in [0, 1].
Light from_srgb(const Eigen::Array3f& srgb);
/// What from_srgb makes of each value of a channel of 8 bits.
const std::array<float, 256>& light_of_srgb8();

}  // namespace crowdface
