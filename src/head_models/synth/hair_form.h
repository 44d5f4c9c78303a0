// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/hair_cut.h"

namespace crowdface::synth {

/// Returns the approximate signed distance of a point from the average head, cm. The ears of this
/// head are ellipsoids.
double head_distance(const Eigen::Vector3d& p);
/// Returns the unit gradient of head_distance.
Eigen::Vector3d head_distance_gradient(const Eigen::Vector3d& p);

// The next three functions describe the form of a haircut on the average head. The points passed to
// the functions are on or near the scalp, in cm.
/// Returns the signed distance from the edge of the hair-covered area, cm; positive inside.
double distance_inside_hair(const HairCut& cut, const Eigen::Vector3d& p);
/// Returns the distance of the hair from the scalp, cm; small at the edges and at the parting.
double hair_stand_off(const HairCut& cut, const Eigen::Vector3d& p);
/// Returns the combing direction, a unit vector tangent to the scalp.
Eigen::Vector3d combing_direction(const HairCut& cut, const Eigen::Vector3d& p);

/// A hair mesh of quads under construction. Vertex i has texture coordinate i.
struct HairMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> uvs;  ///< one per point
  Topology topology;

  /// Returns the complete mesh. There must be at least one point.
  Mesh to_mesh() &&;
};

/// Adds a cap below the hair cards, which fills the gaps between cards. The cap is the hair-covered
/// scalp, raised by hair_stand_off. The cap shows the last strip of hair_picture, with the tips at
/// the cap's edge.
void add_hair_cap(const HairCut& cut, HairMesh& hair);

}  // namespace crowdface::synth
