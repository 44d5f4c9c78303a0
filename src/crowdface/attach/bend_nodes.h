// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/core/compressed_rows.h"

namespace crowdface {

/// The nodes of a moving-least-squares deformation of an attachment. A patch of skin determines the
/// motion of each node. Each point of the attachment moves by a weighted mean of the motions of
/// nearby nodes.
struct BendNodes {
  /// A point of the attachment becomes a node if its distance from each earlier node is at least
  /// this fraction of the radius of the earlier node's patch. (ShapeBend ignores an earlier node
  /// whose root is far away along the skin's surface.)
  static constexpr double kNodeSpacing = 0.3;
  /// Distance up to which a node influences points, in multiples of the node spacing (kNodeSpacing
  /// times the radius of the node's patch).
  static constexpr double kInfluenceRadius = 2;

  /// The weight of one node's motion in the motion of one point.
  struct NodeWeight {
    std::uint32_t node;  ///< index of the node in `patches`
    /// weight of the node's motion in the point's motion; the weights of one point do not sum to
    /// one
    float weight;
  };
  /// for each node: the patch of skin that the node follows
  std::vector<FittedSkin::Patch> patches;
  /// for each point of the attachment: the nodes that influence the point
  CompressedRows<NodeWeight> node_weights;

  std::size_t memory_bytes() const {
    std::size_t bytes = node_weights.items.size() * sizeof(NodeWeight);
    for (const FittedSkin::Patch& patch : patches) {
      bytes += sizeof(patch) + patch.vertices.size() * (sizeof(std::uint32_t) + sizeof(double));
    }
    return bytes;
  }
};

}  // namespace crowdface
