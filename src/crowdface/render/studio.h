// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "crowdface/render/light.h"
#include "crowdface/render/surface_kind.h"

namespace crowdface {

/// How a surface reflects light.
struct Material {
  LinearRgb albedo;
  /// How far diffuse light reaches beyond the terminator ("wrap lighting"), for each colour
  /// channel. A surface gets diffuse light if the cosine of the angle between its normal and the
  /// direction to the lamp is above −wrap.
  LinearRgb wrap;
  float roughness;    ///< roughness of the microfacets; 0 is a mirror
  float reflectance;  ///< fraction of light that is reflected specularly at normal incidence
};

/// The material of surfaces of this kind.
const Material& material_of(SurfaceKind kind);

/// A light at infinite distance.
struct Lamp {
  Eigen::Vector3f direction;  ///< unit vector towards the lamp
  LinearRgb colour;           ///< linear colour times intensity
};

/// Portrait lighting that is fixed to the camera: a large key light from the upper left, a weak
/// fill light from the right, two rim lights from behind, and a sky.
struct Studio {
  Lamp key, fill, rim_right, rim_left;
  LinearRgb sky_above, sky_below;  ///< light of the sky from straight above and straight below
};

/// The lighting of all renders.
const Studio& studio();

/// Default albedo of surfaces of this kind, for surfaces without a colour of their own.
LinearRgb albedo_of(SurfaceKind kind);

/// Whether the key light can illuminate a surface with this normal.
bool can_receive_key_light(const Eigen::Vector3f& normal, SurfaceKind kind);

/// Unit vector towards the centre of the key light.
Eigen::Vector3f key_light_direction();
/// Sine of the key light's angular radius.
inline constexpr float kKeyLightRadius = 0.16F;

/// Background colour, lighter at the top. \param y  from 0 (top) to 1.
LinearRgb background_colour(float y);

}  // namespace crowdface
