// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/core/grouped.h"

namespace crowdface {

/// Places from which points hear the skin around.
struct BendPlaces {
  /// None is within this distance of another, and each point within that of one: a share of how far they hear the
  /// skin.
  static constexpr double kApart = 0.3;
  /// How far points hear a place, in such distances.
  static constexpr double kHeard = 2;

  /// What a point hears of a place.
  struct Share {
    std::uint32_t place;
    float weight;  ///< not of sum one
  };
  std::vector<FittedSkin::Patch> patches;
  Grouped<Share> shares;  ///< #points

  std::size_t memory_bytes() const {
    std::size_t bytes = shares.items.size() * sizeof(Share);
    for (const FittedSkin::Patch& patch : patches) {
      bytes += sizeof(patch) + patch.vertices.size() * (sizeof(std::uint32_t) + sizeof(double));
    }
    return bytes;
  }
};

}  // namespace crowdface
