// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/topology.h"
#include "head_models/synth/hair_form.h"

namespace crowdface::synth {

/// Adds the hair in cards (narrow strips of quads, seen from both sides), as it sits on the average head.
/// Each card shows one of the first strips of hair_picture from its root (v = 1) to its tips. The same on every
/// machine.
void add_hair_cards(const HairCut& cut, HairMesh& hair);

/// Cards and what lies below them.
Mesh head_of_hair(const HairCut& cut);

}  // namespace crowdface::synth
