// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// +1, or −1 if the surface as a whole is wound inside out, as a mirrored one is: its faces look
/// towards its middle.
float winding(const Topology& topology, const Positions& positions);

/// Turns faces round: each keeps its first corner and has the others in reverse order.
void turn_faces(Topology& topology);

/// Whether the faces of a mesh look inward, beyond doubt: measured from the middle of its area, so that small parts beside a
/// large open surface do not decide.
bool is_inside_out(const Topology& topology, const Positions& positions);

}  // namespace crowdface
