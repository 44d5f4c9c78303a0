// SPDX-License-Identifier: Apache-2.0
// What lights the pictures and how surfaces throw it back: numbers that shading.cpp and shade_batch.cpp share.
#pragma once

#include <Eigen/Core>

#include "crowdface/render/shading.h"

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

struct Studio {
  Lamp key, fill, rim_right, rim_left;
  Light sky_above, sky_below;
};

const Studio& studio();

}  // namespace crowdface
