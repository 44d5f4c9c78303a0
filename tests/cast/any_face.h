// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crowdface/cast/draw_recipe.h"

namespace crowdface::testing {

/// A face of no group, drawn by the crowd's own numbers.
inline FacePlan draw_any_face(const CastingOptions& casting, std::uint64_t index,
                              std::uint32_t attempt = 0) {
  return random_face(casting, index, attempt, distribution_of_group(casting));
}

}  // namespace crowdface::testing
