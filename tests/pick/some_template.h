// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/synth/synthetic_head.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface::testing {

/// A synthetic head with eyes, in centimetres; all have the same vertices.
inline Positions some_head(std::uint64_t index) {
  return SyntheticHeads(8000, SyntheticHeads::Parts::kEyesAndTeeth).positions(1, index);
}

inline WrapTemplate some_template() {
  const SyntheticHeads heads(8000, SyntheticHeads::Parts::kEyesAndTeeth);
  return make_template(heads.topology(), 10 * some_head(0), {});
}

}  // namespace crowdface::testing
