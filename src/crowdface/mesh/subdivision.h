// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// One round of Catmull-Clark subdivision. A polygon of k corners becomes k quads, in the order of
/// the polygon's corners: polygon f becomes the quads [face_offsets[f], face_offsets[f + 1]), where
/// face_offsets belongs to `mesh`. The result lists the old vertices first, then one vertex for
/// each edge, then one for each polygon. Boundary edges become cubic curves that do not depend on
/// the interior. New texture coordinates are midpoints, so that they stay inside the borders of the
/// texture; the result has texture coordinates only if all corners of `mesh` have one. Source:
/// Catmull & Clark 1978, "Recursively generated B-spline surfaces on arbitrary topological meshes";
/// boundary edges as in Hoppe et al. 1994, "Piecewise smooth surface reconstruction".
Mesh subdivide(const Mesh& mesh);

/// Returns the number of subdivision rounds, 0 to 8, that brings the number of vertices closest to
/// `wanted_vertices` (ratio closest to 1).
int subdivision_rounds(const Topology& topology, Index wanted_vertices);

}  // namespace crowdface
