// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/require.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/synth/complexion.h"
#include "crowdface/synth/layout.h"
#include "crowdface/synth/synthetic_head.h"
#include "crowdface/synth/unwrap.h"

namespace crowdface {

std::vector<std::uint8_t> synthetic_region_mask(int size) {
  require(size >= 1, "a mask of ", size, " pixels");
  using synth::row_unit;
  using synth::strip_v;
  // Between brow and eye, and between nose and lips. Where two people meet in less, a ridge is seen.
  const double brow = strip_v(row_unit(2)), under_eye = strip_v(row_unit(3));
  const double nose = strip_v(row_unit(5)), lips = strip_v(row_unit(6));
  const double eye = (brow + under_eye) / 2, half = 0.55 * (brow - under_eye);
  const double upper = eye + 0.3 * (brow - under_eye), lower = (nose + lips) / 2;
  std::vector<std::uint8_t> out;
  for (int row = 0; row < size; ++row) {
    const double v = 1 - (row + 0.5) / size;
    const auto top = synth::to_byte(smooth_step(upper - half, upper + half, v));
    const auto bottom = synth::to_byte(smooth_step(lower + half, lower - half, v));
    for (int column = 0; column < size; ++column) {
      out.push_back(top);
      out.push_back(static_cast<std::uint8_t>(255 - top - bottom));
      out.push_back(bottom);
    }
  }
  return out;
}

}  // namespace crowdface
