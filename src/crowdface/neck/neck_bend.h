// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/neck/open_rims.h"

namespace crowdface {

/// Smooth displacements of the skin above a rim. The caller gives the displacements of the rim. At
/// the distance `falloff` along the surface, the displacements are zero with zero slope. Between
/// the rim and this distance, the displacements minimise the bending energy (the biharmonic
/// equation, discretised with the cotangent Laplacian). One factorisation serves all displacements.
class NeckBend {
 public:
  /// \param falloff  in the unit of the positions, measured along edges of `positions`
  NeckBend(const Topology& topology, const Adjacency& adjacency, const Positions& positions,
           const Rim& rim, double falloff);
  ~NeckBend();
  NeckBend(NeckBend&&) noexcept;

  /// Indices of the vertices above the rim that move with the rim, ascending.
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }
  /// Returns the displacements of `vertices()`.
  /// \param rim_moves  displacements of the rim's vertices, one row for each.
  Positions bend(const Positions& rim_moves) const;

 private:
  struct Factorisation;  ///< the factorised equations for the displacements of `vertices_`
  std::vector<std::uint32_t> vertices_;  ///< the vertices that move with the rim, ascending
  std::unique_ptr<const Factorisation> factorisation_;
};

}  // namespace crowdface
