// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "head_models/synth/relief.h"
#include "head_models/synth/skin_atlas.h"

namespace crowdface::synth {

/// Returns the median distance on the skin between horizontally neighbouring texels, cm.
double texel_cm(const SkinAtlas& atlas);

/// Returns a tangent-space normal map of the relief that is too fine for the mesh, as 8-bit RGB.
/// The red channel is the component towards larger u, the green channel the component towards
/// larger v. Eyeballs are smooth.
/// \param texel_size_cm  texel_cm() of the atlas.
/// \param relief  the relief that the mesh does not represent.
std::vector<std::uint8_t> skin_normals(const SkinAtlas& atlas, double texel_size_cm,
                                       const Relief& relief);

/// Returns the roughness of the skin at a place, 0 … 1: low on lips, nose and forehead, lowest on
/// eyes.
/// \param on_lips  1 on the lips, 0 elsewhere.
/// \param hair     fraction of the skin that hair covers, 0 … 1.
/// \param aged     Person::scaled_age().
double skin_roughness(const AtlasTexel& place, double on_lips, double hair, double aged);

}  // namespace crowdface::synth
