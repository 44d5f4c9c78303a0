// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/render/face_renderer.h"

namespace crowdface {

/// What the faces of a crowd's mesh are made of: by the config, by the names of their materials, by shape.
/// What the material file lets one see through, such as cards of lashes, is hidden.
Surfaces surfaces_of(const Config& config, const Inputs& inputs);

}  // namespace crowdface
