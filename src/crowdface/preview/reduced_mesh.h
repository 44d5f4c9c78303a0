// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// Fewer triangles over some of a topology's own vertices: one reduced mesh serves every face of a
/// crowd, whose previews are then no more than the positions of these vertices.
struct ReducedMesh {
  std::vector<std::uint32_t> vertices;   ///< rows of the whole mesh, each once
  std::vector<std::uint32_t> triangles;  ///< three rows of `vertices` each
};

/// Collapses edges until at most `most_triangles` are left, where least is lost on a typical face
/// (quadric error metrics, Garland & Heckbert 1997, by meshoptimizer).
/// \param typical  #V by 3.
/// \param drawn    one a face, or empty: all. Faces that are not drawn are left out.
/// \return         no triangles if nothing is drawn.
/// \throws BrokenPrecondition if sizes do not fit, InvalidInput if a position is not finite.
ReducedMesh reduce_mesh(const Topology& topology, const Positions& typical,
                        const std::vector<bool>& drawn, std::size_t most_triangles);

/// The same of triangles. Open borders, and seams (borders at which several vertices have one
/// position), keep their course: their edges collapse along them alone, and what cannot be collapsed
/// so is kept, be it more than `most`.
/// \param positions  #V by 3, finite.
std::vector<Triangle> reduce_triangles(const std::vector<Triangle>& triangles,
                                       const Positions& positions, std::size_t most);

/// The same again, but what nobody sees gets few of the triangles. Where seen and hidden triangles meet no
/// edge collapses, so that no gap opens between them.
/// \param hidden       #triangles
/// \param most         of all together.
/// \param most_hidden  of those that are hidden.
std::vector<Triangle> reduce_hidden(const std::vector<Triangle>& triangles,
                                    const Positions& positions, const std::vector<bool>& hidden,
                                    std::size_t most, std::size_t most_hidden);

}  // namespace crowdface
