// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

namespace crowdface {

inline constexpr double kFarthest =
    1e9;  ///< that a landmark may be from the origin, along each axis

/// A named place as a file of landmarks has it: the number of a vertex, from 0, or x y z.
struct LandmarkPlace {
  bool is_vertex = false;
  std::uint64_t vertex = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::string where;  ///< "file:line:column", for messages
};

}  // namespace crowdface
