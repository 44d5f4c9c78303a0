// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Keeps the part of a mesh in which a function is not negative. The function is given at the
/// vertices, and is linear along edges. A polygon on which the function changes its sign is clipped
/// (Sutherland & Hodgman 1974). All old vertices and texture coordinates keep their rows, even if
/// no polygon uses them any more. New vertices and texture coordinates get the rows after the old
/// rows.
/// \param signed_distances  #V: the function at each vertex
Mesh cut_mesh(const Mesh& mesh, std::span<const double> signed_distances);

}  // namespace crowdface
