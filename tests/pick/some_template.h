// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/wrap/wrap_template.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface::testing {

/// A synthetic head with eyes, in centimetres; all have the same vertices.
inline Positions some_head(std::uint64_t index) {
  return SyntheticHeads(8000, SyntheticHeads::Parts::kEyesAndTeeth).positions(1, index);
}

inline WrapTemplate some_template() {
  const SyntheticHeads heads(8000, SyntheticHeads::Parts::kEyesAndTeeth);
  return make_template(heads.topology(), 10 * some_head(0), {});
}

/// From a head in millimetres to a scan of it: turned, in metres, elsewhere.
inline Similarity some_place() {
  Similarity place;
  place.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  place.scale = 0.001;
  place.translation = {5, -3, 8};
  return place;
}

}  // namespace crowdface::testing
