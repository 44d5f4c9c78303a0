// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/displacements.h"
#include "crowdface/neck/neck_bend.h"

namespace crowdface {

/// The rim of the neck: the ring of vertices in which all faces end. Includes the rim's positions
/// and normals, and the bending of the skin above the rim. Thread-safe.
struct Seam {
  Rim rim;                       ///< the vertices of the rim, as vertex indices of the heads
  Positions positions, normals;  ///< positions and unit normals of the rim's vertices
  NeckBend neck_bend;            ///< bends the skin above `rim`

  /// Bends the neck of a mesh so that the rim has exactly the seam's positions.
  void bend_to_seam(Positions& mesh) const;
  /// Bends the neck of `mesh` so that the rim of `mesh` gets the positions of the rim of `other`.
  void bend_to_rim_of(const Positions& other, Positions& mesh) const;
  /// Changes the displacements of a shape smoothly so that the rim does not move.
  void keep_rim_still(Displacements& moves) const;
  /// Sets the normals at the rim to the seam's normals. \param mesh_normals #V by 3: normals of a
  /// mesh; may be empty
  void set_normals(Positions& mesh_normals) const;
};

}  // namespace crowdface
