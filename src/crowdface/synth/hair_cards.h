// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/topology.h"
#include "crowdface/synth/hair_cut.h"

namespace crowdface::synth {

/// The hair in cards (narrow strips of quads, seen from both sides), as it sits on the average head.
/// Each card shows one of the first strips of hair_picture from its root (v = 1) to its tips. The same on every
/// machine.
Mesh hair_cards(const HairCut& cut);

/// Cards and what lies below them, hair_cap.
Mesh head_of_hair(const HairCut& cut);

}  // namespace crowdface::synth
