// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"

namespace crowdface {

class ChebyshevFilter;

/// Like `smooth` (chebyshev_filter.h), but without copying the caller's positions.
std::vector<Positions> smooth_without_copy(const ChebyshevFilter& filter,
                                           const Eigen::Ref<const Positions>& positions,
                                           std::span<const std::uint64_t> levels);

}  // namespace crowdface
