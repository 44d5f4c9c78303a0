// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {

/// The text of crowd.csv: the crowd as a flat table (RFC 4180) for spreadsheets, one line for each
/// face. The table depends on the plan only, so every run over a whole crowd writes it. Both
/// arguments must outlive the text.
TextPieces table_text(const std::vector<FacePlan>& crowd, const PlanNames& names);

}  // namespace crowdface
