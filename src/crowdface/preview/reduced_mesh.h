// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// Collapses edges until at most `most` triangles are left, where least is lost (quadric error metrics,
/// Garland & Heckbert 1997, by meshoptimizer). Open borders, and seams (borders at which several
/// vertices have one position), keep their course: their edges collapse along them alone, and what
/// cannot be collapsed so is kept, be it more than `most`.
/// \param positions  #V by 3, finite.
std::vector<Triangle> reduce_triangles(const std::vector<Triangle>& triangles,
                                       const Positions& positions, std::size_t most);

/// Fewer triangles over some of a mesh's own vertices, numbered in the order in which triangles first use them.
struct ReducedMesh {
  std::vector<std::uint32_t> vertices;  ///< rows of the whole mesh, each once
  std::vector<Triangle> triangles;      ///< of `vertices`
};

ReducedMesh reduce_mesh(const std::vector<Triangle>& triangles, const Positions& positions,
                        std::size_t most);

/// The same as reduce_triangles, but what nobody sees gets few of the triangles. Where seen and hidden triangles meet no
/// edge collapses, so that no gap opens between them.
/// \param hidden       #triangles
/// \param most         of all together.
/// \param most_hidden  of those that are hidden.
std::vector<Triangle> reduce_hidden(const std::vector<Triangle>& triangles,
                                    const Positions& positions, const std::vector<bool>& hidden,
                                    std::size_t most, std::size_t most_hidden);

}  // namespace crowdface
