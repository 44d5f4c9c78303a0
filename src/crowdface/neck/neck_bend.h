// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/neck/open_rims.h"

namespace crowdface {

/// Smooth displacements of the skin above a rim. They are given at the rim, and zero with zero
/// slope at the distance `falloff` along the surface. Between, they have the least bending energy
/// (the biharmonic equation, discretised with the cotangent Laplacian). One factorisation serves
/// all displacements.
class NeckBend {
 public:
  /// \param falloff  in the unit of the positions, measured along edges of `positions`
  NeckBend(const Topology& topology, const Adjacency& adjacency, const Positions& positions,
           const Rim& rim, double falloff);
  ~NeckBend();
  NeckBend(NeckBend&&) noexcept;

  /// The vertices that a displacement of the rim moves, without the rim, ascending.
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }
  /// Displacements of `vertices()`. \param rim_moves  #rim by 3
  Positions bend(const Positions& rim_moves) const;

 private:
  struct Factors;
  std::vector<std::uint32_t> vertices_;
  std::unique_ptr<const Factors> factors_;
};

}  // namespace crowdface
