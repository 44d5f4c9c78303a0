// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "crowdface/core/parallel.h"
#include "crowdface/texture/surface_texels.h"

namespace crowdface {

/// Fills the uncovered texels of a texture image with `fill`, and then copies covered texels into
/// the gutter.
/// \param fill    one value per channel
/// \param values  height by width by #channels.
template <class Value>
void fill_uncovered(const SurfaceTexels& texels, std::span<const Value> fill, Value* values) {
  // A parallel task of the first loop fills kRowsPerBlock rows; a parallel task of the second loop
  // fills kGutterTexelsPerBlock gutter texels.
  constexpr int kRowsPerBlock = 16;
  constexpr std::size_t kGutterTexelsPerBlock = 1 << 14;
  const std::size_t channels = fill.size();
  const auto width = static_cast<std::size_t>(texels.width());
  parallel_for_each(texels.height(), kRowsPerBlock, [&](int y) {
    std::size_t x = static_cast<std::size_t>(y) * width;
    const std::size_t row = x, end = x + width;
    const auto fill_to = [&](std::size_t stop) {
      for (; x < stop; ++x) std::copy_n(fill.data(), channels, values + channels * x);
    };
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      fill_to(row + span.begin);
      x = row + span.end;
    }
    fill_to(end);
  });
  const auto& gutter = texels.gutter();
  parallel_for_each(gutter.size(), kGutterTexelsPerBlock, [&](std::size_t i) {
    std::copy_n(values + channels * std::size_t{gutter[i].source}, channels,
                values + channels * std::size_t{gutter[i].target});
  });
}

}  // namespace crowdface
