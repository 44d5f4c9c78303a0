// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

namespace crowdface {

/// Largest absolute value that a coordinate of a landmark in a file may have, in the unit of the
/// mesh.
inline constexpr double kMaxCoordinate = 1e9;

/// A landmark in a file: the number of a vertex, from 0, or a point.
struct LandmarkPlace {
  bool is_vertex = false;    ///< whether the file has a vertex number and not a point
  std::uint64_t vertex = 0;  ///< number of the vertex, from 0; unused if `is_vertex` is false
  /// coordinates of the landmark; unused if `is_vertex` is true
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// place of the landmark in the file, as "file:line:column", for messages
  std::string file_location;
};

}  // namespace crowdface
