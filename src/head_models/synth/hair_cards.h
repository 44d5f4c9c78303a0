// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/topology.h"
#include "head_models/synth/hair_form.h"

namespace crowdface::synth {

/// Adds hair cards (narrow, two-sided strips of quads) on the average head. Each card shows one of
/// the first kCardStripCount strips of hair_picture from its root (v = 1) to its tip. The result
/// has the same bits on every machine.
void add_hair_cards(const HairCut& cut, HairMesh& hair);

/// Returns a mesh of the hair cards and of the cap below the cards (add_hair_cap).
Mesh head_of_hair(const HairCut& cut);

}  // namespace crowdface::synth
