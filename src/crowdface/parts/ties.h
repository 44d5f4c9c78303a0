// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// What of the bound parts lies at a rigid part and goes along with it: gums with the teeth in them.
class Ties {
 public:
  Ties() = default;
  /// \param positions  of the head on which distances are measured
  /// \param rigid      the vertices of each rigid part that ties
  /// \param bound      vertices that may be tied
  /// \param reach      a vertex this far off is free, one at the part is wholly tied
  Ties(const Positions& positions, const std::vector<std::span<const std::uint32_t>>& rigid,
       std::span<const std::uint32_t> bound, double reach);

  /// Moves the tied vertices of `result` from where they are bound towards where the motions carry
  /// them.
  /// \param motions  #rigid
  void pull(const Positions& target, std::span<const RigidMotion> motions, Positions& result) const;

  std::size_t size() const { return ties_.size(); }

 private:
  struct Tie {
    std::uint32_t vertex, part;
    double share;  ///< those of a vertex add up to one at most
  };
  std::vector<Tie> ties_;  ///< those of a vertex one after the other
};

}  // namespace crowdface
