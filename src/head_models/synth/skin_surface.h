// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "head_models/synth/relief.h"
#include "head_models/synth/skin_atlas.h"

namespace crowdface::synth {

/// The usual distance between the places of neighbouring texels, cm.
double texel_cm(int size, const std::vector<SkinPlace>& atlas);

/// Tangent-space normals of relief that a mesh is too coarse for, as 8-bit RGB. Red leans to the right of the
/// picture, green to its top. Eyeballs are smooth.
/// \param atlas  size · size. \param fine, coarse  the relief of the head, and what its mesh carries of it.
std::vector<std::uint8_t> skin_normals(int size, const std::vector<SkinPlace>& atlas,
                                       const Relief& fine, const Relief& coarse);

/// How rough one person's skin is at a place, 0 … 1: lips, nose and forehead gleam, eyes most.
/// \param aged  as Person::aged has it.
double skin_roughness(const SkinPlace& place, double on_lips, double hair, double aged);

}  // namespace crowdface::synth
