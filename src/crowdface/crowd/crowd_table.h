// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {

/// crowd.csv: the crowd as a flat table (RFC 4180) for spreadsheets, one line a face. The table follows from the plan
/// alone, so every run over a whole crowd writes it. Both must outlive the text.
TextPieces table_text(const std::vector<CastFace>& crowd, const PlanNames& names);

}  // namespace crowdface
