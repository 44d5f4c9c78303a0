// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/core/hash.h"

namespace crowdface {

/// One line of the plan as a JSON value.
nlohmann::ordered_json face_to_json(const FacePlan& face, const PlanNames& names,
                                    const Digest& settings);

}  // namespace crowdface
