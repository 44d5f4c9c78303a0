// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/likeness.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// How the faces follow each other: indices into the crowd.
std::vector<std::size_t> sheet_order(SheetOrder order, const std::vector<CastFace>& crowd,
                                     const Likeness& likeness);

/// What stands under a face, a line for each label.
std::string sheet_label(const std::vector<SheetLabel>& labels, const std::vector<CastFace>& crowd,
                        std::size_t face, const Likeness& likeness,
                        const std::vector<std::string>& heads);

}  // namespace crowdface
