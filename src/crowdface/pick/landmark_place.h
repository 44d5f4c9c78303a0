// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

namespace crowdface {

/// Largest absolute coordinate of a landmark.
inline constexpr double kMaxCoordinate = 1e9;

/// A landmark in a file: the number of a vertex, from 0, or a point.
struct LandmarkPlace {
  bool is_vertex = false;    ///< whether the file has a vertex number and not a point
  std::uint64_t vertex = 0;  ///< number of the vertex, from 0; unused if `is_vertex` is false
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< unused if `is_vertex` is true
  std::string file_location;                        ///< "file:line:column", for messages
};

}  // namespace crowdface
