// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// In single precision, and never smaller than in double.
struct Box {
  std::array<float, 3> low, high;
};

bool overlap(const Box& a, const Box& b);

/// Boxes of up to eight triangles that lie near each other, side by side for the processor; where there are fewer,
/// boxes that overlap nothing.
struct LeafBoxes {
  static constexpr std::size_t kCount = 8;
  std::array<std::array<float, kCount>, 3> low, high;

  LeafBoxes() = default;
  /// \param numbers  of the triangles, at most kCount
  /// \param margin   by which boxes are grown on all sides
  LeafBoxes(std::span<const std::uint32_t> numbers, std::span<const Triangle> triangles,
            const Positions& positions, double margin);
  /// Around all of them.
  Box whole() const;
};

/// Which boxes of two leaves overlap: bit 8 i + j for box i of the first and box j of the second.
std::uint64_t overlapping(const LeafBoxes& a, const LeafBoxes& b);

}  // namespace crowdface
