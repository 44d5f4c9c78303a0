// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/mesh/vector3.h"
#include "crowdface/neck/open_rims.h"

namespace crowdface {

/// The rim at the heads' neck: the lowest of the long open rims.
/// \param up  unit vector
/// \param mm  millimetres per unit of the positions
/// \throws InvalidInput if there is no open rim, or if two long rims are equally low.
Rim lowest_rim(const std::vector<Rim>& rims, const Positions& positions, const Eigen::Vector3d& up,
               double mm);

/// Whether the order of the vertices in the body's rim is known.
enum class RimOrder {
  kFree,   ///< the body's rim may start at any vertex and run in either direction
  kGiven,  ///< vertex i of the body's rim belongs to vertex i of the heads' rim
};

/// The match of a body's rim with the heads' rim.
struct RimMatch {
  Rim rim;  ///< the matching vertex of the body for each vertex of the heads' rim
  double centroid_distance_mm = 0;  ///< distance between the centroids of both rims, in mm
  std::string mismatch_reason;      ///< why the rims do not match; empty if they do
};

/// Matches the vertices of two rims with the same number of vertices. Tries every start vertex in
/// both directions. Returns the order with the smallest sum of squared distances, unless another
/// order is much closer to the heads' rim after a rigid motion.
/// \param head_rim  positions of the vertices of the heads' rim in mm, one row for each, in the
///                  order of the rim
/// \param body_positions  positions of the whole body, in mm
/// \param max_distance_mm  largest distance between the rims; callers pass the config value
///                         `neck.falloff`
RimMatch match_rims(const Positions& head_rim, const Rim& body_rim, const Positions& body_positions,
                    double max_distance_mm, RimOrder order = RimOrder::kFree);

/// Finds the rim of a body that matches the heads' rim.
/// \throws InvalidInput if no rim matches or if several match. The message lists the vertex counts
///         and offsets of the nearest rims.
Rim find_matching_rim(const Positions& head_rim, const std::vector<Rim>& body_rims,
                      const Positions& body_positions, double max_distance_mm,
                      RimOrder order = RimOrder::kFree);

}  // namespace crowdface
