// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/cast/compared_area.h"

namespace crowdface {

/// Returns the distances (`face_distance`) between all pairs of faces, N by N, symmetric. Does not
/// copy the faces, which are views of memory that other objects own.
///
/// \param areas  #V, weights of the vertices; not all zero.
Eigen::MatrixXd face_distances(std::span<const Eigen::Map<const Positions>> faces,
                               const std::vector<double>& areas);

}  // namespace crowdface
