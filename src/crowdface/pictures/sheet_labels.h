// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/likeness.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// The order of the faces on a sheet, as indices into `crowd`.
std::vector<std::size_t> sheet_order(SheetOrder order, const std::vector<FacePlan>& crowd,
                                     const Likeness& likeness);

/// The text under a face, one line per label.
/// \param heads  names of the heads.
/// \param tags   tags of each head.
std::string sheet_label(const std::vector<SheetLabel>& labels, const std::vector<FacePlan>& crowd,
                        std::size_t face, const Likeness& likeness,
                        const std::vector<std::string>& heads,
                        const std::vector<std::vector<std::string>>& tags);

/// The text under a child on its family's sheet: id, percentage of the face shape that comes from
/// the mother, and the regions from each parent. If a region has bands of detail from both parents,
/// the text lists these bands separately.
std::string inheritance_label(const FacePlan& face, const PlanNames& names);

}  // namespace crowdface
