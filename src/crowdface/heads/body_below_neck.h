// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/neck/open_rims.h"

namespace crowdface {

/// The ring at the heads' neck: the ring that `neck.rim` names, or the lowest open rim.
/// \throws InvalidInput if there is none.
Rim find_neck_rim(const Config& config, const Inputs& inputs);

/// For each vertex of a rim: the sum of the area vectors of the polygons around the vertex. One row
/// for each vertex of the rim.
Positions area_vectors_around(const Topology& topology, const Positions& positions, const Rim& rim);

/// The body whose file the config names as `neck.body`.
struct BodyBelowNeck {
  /// positions of the vertices of the body's rim, one row for each, in the order of the heads' rim
  Positions rim_positions;
  Positions area_vectors;  ///< result of area_vectors_around for the body's rim
  /// Whether the file contains a head with the heads' topology, instead of a body.
  bool file_contains_head = false;
  Positions head_positions = {};  ///< if the file contains a head: positions of its whole mesh
  /// The body's mesh, stored like an attachment; null if the config does not need the mesh.
  std::shared_ptr<Attachment> mesh = {};
  Rim mesh_rim = {};  ///< the vertices of `mesh` at the rim, in the order of the heads' rim

  /// If the body's polygons face inward, reverses them, so that they face outward like the heads'
  /// polygons.
  /// \param head_areas  the area vectors of the heads' polygons around the rim
  void reverse_inward_polygons(const Positions& head_areas);
};

/// Reads the body and matches its rim with the heads' rim. If the config names the body's rim
/// (`neck.body_rim`), removes the polygons above this rim, such as the body's own head.
/// \param rim   the heads' rim
/// \param ring  mean positions, over the heads, of the vertices of the heads' rim; one row for each
/// \throws InvalidInput if no rim fits. Also throws InvalidInput if the config needs a body, but
///         the body's file (`neck.body`) contains a head with the heads' topology instead.
BodyBelowNeck read_body_below_neck(const Config& config, const Inputs& inputs, const Rim& rim,
                                   const Positions& ring);

}  // namespace crowdface
