// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Vertices whose numbers of all fields stand together, so that blending them reads one piece of memory
/// a head.
inline constexpr std::size_t kFieldTile = 64;

/// Fields c_0 … c_{R−1} of one head, #V by 3 each, as whole numbers of 16 bits times a step a field:
/// half of what single precision takes to read. A field is off by half its step at most.
struct LevelFields {
  Index vertex_count = 0;
  std::vector<double> steps;  ///< #R, in the positions' unit
  /// #tiles by #R by kFieldTile by 3; past the last vertex zero.
  std::span<const std::int16_t> numbers;
  std::shared_ptr<const void> owner;  ///< of the numbers

  Index rank() const { return static_cast<Index>(steps.size()); }
  /// How many numbers so many fields take.
  static std::size_t size(std::size_t vertices, std::size_t rank) {
    return (vertices + kFieldTile - 1) / kFieldTile * rank * kFieldTile * 3;
  }
  std::int16_t number(Index field, Index vertex, Index coordinate) const {
    const auto v = static_cast<std::size_t>(vertex), p = static_cast<std::size_t>(field);
    const std::size_t row = (v / kFieldTile * steps.size() + p) * kFieldTile + v % kFieldTile;
    return numbers[3 * row + static_cast<std::size_t>(coordinate)];
  }
  double value(Index field, Index vertex, Index coordinate) const {
    return steps[static_cast<std::size_t>(field)] *
           static_cast<double>(number(field, vertex, coordinate));
  }
};

/// \param fields  #R by #V by 3, finite.
LevelFields in_16_bits(std::span<const float> fields, Index vertex_count);

}  // namespace crowdface
