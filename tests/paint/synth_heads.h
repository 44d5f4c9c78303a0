// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "head_models/synth/synthetic_head.h"

namespace crowdface::testing {

inline HeadSet synth_heads(Index vertices, std::uint64_t count = 3) {
  const SyntheticHeads heads(vertices, SyntheticHeads::Parts::kEyesAndTeeth);
  HeadSet set{heads.topology(), heads.uvs(), {}};
  for (std::uint64_t i = 1; i <= count; ++i) set.heads.push_back({"", heads.positions(1, i)});
  return set;
}

}  // namespace crowdface::testing
