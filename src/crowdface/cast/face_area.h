// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/adjacency.h"

namespace crowdface {

/// What counts when two faces are compared.
enum class FaceArea {
  kFront,  ///< the skin in front of the head's middle: the face
  kSkin,   ///< all of the skin, the back of the head and the neck too
};

/// How much each vertex counts in a distance: the area around it on the mean head (each polygon
/// shared out among its corners), zero where it is no part of the face. The skin is the largest
/// component, so that eyeballs, teeth and lashes never count.
/// \param mask  #V factors on top, or empty.
std::vector<double> face_areas(const Topology& topology, const Components& components,
                               const Positions& mean, FaceArea area, Axis front,
                               const std::vector<double>& mask = {});

/// The distance between two built faces of one topology: root mean square over all vertices, after
/// the second was moved rigidly onto the first, in the positions' unit.
/// \param areas  #V, how much each vertex counts; not all zero.
/// \throws BrokenPrecondition if the sizes differ; InvalidInput if there are fewer than 3 vertices.
double face_distance(const Positions& a, const Positions& b, const std::vector<double>& areas);

}  // namespace crowdface
