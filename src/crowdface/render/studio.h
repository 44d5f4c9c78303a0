// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "crowdface/render/light.h"
#include "crowdface/render/surface_kind.h"

namespace crowdface {

struct Material {
  Light albedo;
  Light wrap;         ///< how far light reaches past the shadow's edge, as a cosine
  float roughness;    ///< of the microfacets, 0 a mirror
  float reflectance;  ///< at normal incidence
};

const Material& material_of(SurfaceKind kind);

struct Lamp {
  Eigen::Vector3f direction;  ///< towards it, unit
  Light colour;
};

/// A portrait studio that moves with the camera: a large key light from the upper left, a weak fill
/// from the right, two rims from behind and a sky.
struct Studio {
  Lamp key, fill, rim_right, rim_left;
  Light sky_above, sky_below;
};

const Studio& studio();

/// What a surface of this kind reflects where no colour is given.
Light albedo_of(SurfaceKind kind);

/// Whether any light of the key comes off a surface of this normal.
bool faces_key(const Eigen::Vector3f& normal, SurfaceKind kind);

/// Towards the middle of the key light (unit), and the sine of its angular radius.
Eigen::Vector3f key_direction();
inline constexpr float kKeyRadius = 0.16F;

/// The backdrop, lighter on top; `y` from 0 (top) to 1.
Light background(float y);

}  // namespace crowdface
