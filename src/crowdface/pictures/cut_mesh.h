// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Cuts a mesh: keeps the part in which a function, given at the vertices and linear along edges,
/// is not negative. Polygons that cross zero are clipped (Sutherland & Hodgman 1974). All vertices
/// and texture coordinates of the mesh come first, also if no polygon uses them any more; the rows
/// of new vertices follow.
/// \param above  #V: the function at each vertex
Mesh cut_mesh(const Mesh& mesh, std::span<const double> above);

}  // namespace crowdface
