// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/hair_cut.h"

namespace crowdface::synth {

/// Returns the approximate signed distance to the average head with ellipsoids as ears, cm.
double head_distance(const Eigen::Vector3d& p);
/// Returns the unit gradient of head_distance.
Eigen::Vector3d away_from_head(const Eigen::Vector3d& p);

// The overall form of a haircut on the average head. Points are on or near the scalp, cm.
/// Returns the distance from the edge of the hair-covered area, cm; positive inside.
double hair_within(const HairCut& cut, const Eigen::Vector3d& p);
/// Returns the distance of the hair from the scalp, cm; small at the edges and at the parting.
double hair_stand_off(const HairCut& cut, const Eigen::Vector3d& p);
/// Returns the combing direction, a unit vector tangent to the scalp.
Eigen::Vector3d combed_way(const HairCut& cut, const Eigen::Vector3d& p);

/// An incomplete hair mesh of quads; each vertex has one texture coordinate with the same index.
struct HairMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> uvs;  ///< #points
  Topology topology;

  /// Returns the mesh. There must be at least one point.
  Mesh finished() &&;
};

/// Adds a cap below the cards, which fills the gaps between them: the hair-covered scalp, raised by
/// hair_stand_off. Shows the last strip of hair_picture, with the tips at the edge of the cap.
void add_hair_cap(const HairCut& cut, HairMesh& hair);

}  // namespace crowdface::synth
