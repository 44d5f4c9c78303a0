// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// #V by 3 unit normals: the sum of the normals of the faces around a vertex, each weighted by its
/// area (Newell's method for polygons, so quads need not be flat). (0, 0, 1) where the sum
/// vanishes.
Positions vertex_normals(const Topology& topology, const Positions& positions);

/// Twice the vector area of one face (Newell's method): its direction is the face's normal, its
/// length twice the face's area if the face is flat.
Eigen::Vector3d face_area_vector(const Topology& topology, Index face, const Positions& positions);

}  // namespace crowdface
