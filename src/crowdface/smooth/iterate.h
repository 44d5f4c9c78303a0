// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crowdface/smooth/columns.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// `values` after `level` applications of the operator, one after the other (Eq. 1): the definition
/// that the filter is held against. Costs `level` products.
/// \param values  #V by C.
/// \throws BrokenPrecondition if the row count is not the operator's.
Columns iterate(const SmoothingOperator& smoothing, const Columns& values, std::uint64_t level);

}  // namespace crowdface
