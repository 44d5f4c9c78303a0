// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// The faces in the job's output folder, if it holds a plan that was cast of these heads, masks and
/// smoothing settings; nothing if there is none, or a warning if it is another's.
std::optional<std::vector<CastFace>> crowd_of_job(const Job& job);

}  // namespace crowdface
