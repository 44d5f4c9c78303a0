// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/core/hash.h"

namespace crowdface {

/// Returns a face as the JSON value that the face's line in the plan contains.
nlohmann::ordered_json face_to_json(const FacePlan& face, const PlanNames& names,
                                    const Digest& settings);

}  // namespace crowdface
