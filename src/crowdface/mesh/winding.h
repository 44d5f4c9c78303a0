// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Returns −1 if the polygons of the surface mainly face towards the mean of the vertices, as on a
/// mirrored surface. Returns +1 otherwise.
float winding_sign(const Topology& topology, const Positions& positions);

/// Reverses the orientation of all polygons: each polygon keeps its first corner; its other corners
/// change to reverse order.
void reverse_faces(Topology& topology);

/// Whether the polygons of a mesh clearly face inwards. Directions are relative to the
/// area-weighted centre, so that small parts beside a large open surface have little effect on the
/// result.
bool is_inside_out(const Topology& topology, const Positions& positions);

}  // namespace crowdface
