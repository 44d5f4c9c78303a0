// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// One round of subdivision: a polygon of k corners becomes k quads, in the order of its corners, so
/// that those of face f are the faces [face_offsets[f], face_offsets[f + 1]) of the result. Vertices
/// come first as they were, then one an edge, then one a face. Open edges become cubic curves that
/// do not depend on the inside; texture coordinates are halved between their neighbours, so that
/// they stay within their borders.
/// Source: Catmull & Clark 1978, "Recursively generated B-spline surfaces on arbitrary topological
/// meshes"; open edges as in Hoppe et al. 1994, "Piecewise smooth surface reconstruction".
Mesh subdivide(const Mesh& mesh);

/// How many rounds bring the number of vertices nearest to this one (as a ratio); 0 to 8.
int subdivision_rounds(const Topology& topology, Index wanted_vertices);

}  // namespace crowdface
