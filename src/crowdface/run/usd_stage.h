// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Returns the text of a USD layer in the crowd's folder. The layer references the layers of all
/// faces and places the faces in rows. With levels of detail, each face has a variant set `LOD`.
std::string make_usd_stage_text(const Config& config, const Inputs& inputs,
                                std::span<const FacePlan> crowd);

}  // namespace crowdface
