// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/hair_cut.h"

namespace crowdface::synth {

/// Returns the approximate signed distance of a point from the average head, cm. The ears of this
/// head are ellipsoids.
/// \param has_wide_ears  whether the ellipsoids contain the rear upper parts of ears that stand
///                       off, so that loose long hair hides the ears.
double head_distance(const Eigen::Vector3d& p, bool has_wide_ears = false);
/// Returns the unit gradient of head_distance.
Eigen::Vector3d head_distance_gradient(const Eigen::Vector3d& p, bool has_wide_ears = false);

/// Returns the signed distance of a point from the edge of the hair-covered area, cm; positive
/// inside the area.
/// \param p  point on or near the scalp of the average head, cm.
double distance_inside_hair(const HairCut& cut, const Eigen::Vector3d& p);
/// Returns the distance of the hair from the scalp, cm; small at the edge of the hair-covered area
/// and at the parting.
/// \param p  point on or near the scalp of the average head, cm.
double hair_stand_off(const HairCut& cut, const Eigen::Vector3d& p);
/// Returns the combing direction of the hair, a unit vector tangent to the scalp.
/// \param p  point on or near the scalp of the average head, cm.
Eigen::Vector3d combing_direction(const HairCut& cut, const Eigen::Vector3d& p);

/// A hair mesh of quads under construction. Vertex i has texture coordinate i.
struct HairMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> uvs;  ///< one pair of texture coordinates per point
  Topology topology;

  /// Returns the complete mesh. There must be at least one point.
  Mesh to_mesh() &&;
};

/// Adds a cap below the hair cards, which fills the gaps between cards. The cap is the hair-covered
/// scalp, raised by hair_stand_off. The cap shows the last strip of hair_picture, with the tips at
/// the cap's edge.
void add_hair_cap(const HairCut& cut, HairMesh& hair);

}  // namespace crowdface::synth
