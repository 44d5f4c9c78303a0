// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crowdface/smooth/columns.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Applies the operator `level` times to `values` (Eq. 1). This function is the definition of
/// smoothing; tests compare the fast filter with its result. Costs `level` products with the
/// operator.
/// \param values  #V by C.
/// \throws BrokenPrecondition if `values` does not have one row per vertex of the operator.
Columns iterate(const SmoothingOperator& smoothing, const Columns& values, std::uint64_t level);

}  // namespace crowdface
