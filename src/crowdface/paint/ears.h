// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/mesh/topology.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Where both ears of a head lie, along its axes.
struct EarBox {
  double bottom = 0, top = 0;  ///< heights
  double back = 0, front = 0;
  double inner = 0;  ///< how far from the middle they begin
};

/// What stands out at the sides of the skin between mouth and brows.
/// \return nothing if nothing does.
std::optional<EarBox> find_ears(const Topology& topology, const HeadShape& head,
                                const HeadAxes& axes, const FaceMarks& marks);

}  // namespace crowdface
