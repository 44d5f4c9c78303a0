// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/core/compressed_rows.h"

namespace crowdface {

/// The nodes of a moving-least-squares deformation. A patch of skin determines the motion of each
/// node; each point blends the motions of nearby nodes.
struct BendNodes {
  /// Minimum distance between two nodes, as a fraction of the reach of a node's patch. Every point
  /// of the attachment has a node within this distance.
  static constexpr double kNodeSpacing = 0.3;
  /// Radius within which a node influences points, in multiples of kNodeSpacing.
  static constexpr double kInfluenceRadius = 2;

  /// The weight of one node's motion in the motion of one point.
  struct NodeWeight {
    std::uint32_t node;
    float weight;  ///< weights of a point do not sum to one
  };
  std::vector<FittedSkin::Patch> patches;
  CompressedRows<NodeWeight> node_weights;  ///< #points

  std::size_t memory_bytes() const {
    std::size_t bytes = node_weights.items.size() * sizeof(NodeWeight);
    for (const FittedSkin::Patch& patch : patches) {
      bytes += sizeof(patch) + patch.vertices.size() * (sizeof(std::uint32_t) + sizeof(double));
    }
    return bytes;
  }
};

}  // namespace crowdface
