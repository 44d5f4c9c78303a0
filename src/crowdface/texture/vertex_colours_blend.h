// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/colour_rows.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface {

/// Blends vertex colours: computes the weighted mean of the heads' optical densities. The weights
/// are constant over the face, so that forehead and chin match in colour. Heads without colours get
/// no weight.
/// \param heads  the colours of each head, #V by 3, or no rows; at least one head has colours.
/// \param uses_target_colours_only  for each vertex, whether it uses
///                                  weights.weights_for_eyes_and_teeth instead of
///                                  weights.weights_for_skin; may be empty.
/// \return #V by 3.
ColourRows blend_vertex_colours(const std::vector<ColourRows>& heads,
                                const FaceColourWeights& weights,
                                const std::vector<bool>& uses_target_colours_only);

}  // namespace crowdface
