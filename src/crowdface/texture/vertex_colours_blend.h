// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/colour_rows.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface {

/// A face's colours at vertices: the mean of its heads' optical densities. There is one set of weights for the whole
/// face, so that a forehead is not darker than its chin. Heads without colours lend nothing.
/// \param heads      #heads colours; some may have no rows, not all
/// \param of_target  #V: whether the target alone lends there, as to eyes; or empty
/// \return #V by 3
ColourRows blend_vertex_colours(const std::vector<ColourRows>& heads,
                                const FaceColourWeights& weights,
                                const std::vector<bool>& of_target);

}  // namespace crowdface
