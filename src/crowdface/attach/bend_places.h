// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/core/compressed_rows.h"

namespace crowdface {

/// The nodes of a moving-least-squares deformation. Each node has a patch of skin that determines
/// its motion; each point blends the motions of the nodes around it.
struct BendPlaces {
  /// Minimum distance between two nodes, as a fraction of the reach of a node's patch. Every point
  /// is within this distance of a node.
  static constexpr double kApart = 0.3;
  /// Radius within which a node influences points, in multiples of the distance kApart.
  static constexpr double kHeard = 2;

  /// The weight of one node at one point.
  struct Share {
    std::uint32_t place;
    float weight;  ///< weights of a point do not sum to one
  };
  std::vector<FittedSkin::Patch> patches;
  CompressedRows<Share> shares;  ///< #points

  std::size_t memory_bytes() const {
    std::size_t bytes = shares.items.size() * sizeof(Share);
    for (const FittedSkin::Patch& patch : patches) {
      bytes += sizeof(patch) + patch.vertices.size() * (sizeof(std::uint32_t) + sizeof(double));
    }
    return bytes;
  }
};

}  // namespace crowdface
