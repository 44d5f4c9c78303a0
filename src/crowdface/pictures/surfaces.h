// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/render/face_renderer.h"

namespace crowdface {

/// Determines the surface kind (skin, eye, …) of each polygon of the crowd's mesh from the config
/// and from the names of materials. Finds eyeballs also by their form. Materials that the material
/// file makes transparent, such as lash cards, are hidden.
Surfaces surfaces_of(const Config& config, const Inputs& inputs);

}  // namespace crowdface
