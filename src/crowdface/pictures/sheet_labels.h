// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/likeness.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// How the faces follow each other: indices into the crowd.
std::vector<std::size_t> sheet_order(SheetOrder order, const std::vector<CastFace>& crowd,
                                     const Likeness& likeness);

/// What stands under a face, a line for each label.
/// \param heads, tags  of each head.
std::string sheet_label(const std::vector<SheetLabel>& labels, const std::vector<CastFace>& crowd,
                        std::size_t face, const Likeness& likeness,
                        const std::vector<std::string>& heads,
                        const std::vector<std::vector<std::string>>& tags);

/// What stands under a child on its family's sheet: its id, how much of the form is its mother's, and
/// which regions each parent gave. A region of which each gave bands is told by band.
std::string inheritance_label(const CastFace& face, const PlanNames& names);

}  // namespace crowdface
