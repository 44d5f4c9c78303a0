// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "head_models/synth/synthetic_head.h"

#include "multiscale_faces/front_patch.h"

namespace crowdface::multiscale {

/// Two synthetic heads, in centimetres, and their fronts.
struct TestHeads {
  TestHeads() {
    const SyntheticHeads heads(6000);
    topology = heads.topology();
    const Positions a = heads.positions(1, 0), b = heads.positions(1, 1);
    patch = front_patch(topology, (a + b) / 2, {1, 1}, {2, 1});
    fronts = {patch.rows_of(a), patch.rows_of(b)};
  }
  Topology topology;
  FrontPatch patch;
  std::vector<Positions> fronts;
};

}  // namespace crowdface::multiscale
