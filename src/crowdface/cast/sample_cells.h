// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/cast/face_samples.h"

namespace crowdface {

/// The skin cut into cells, one around each sample: each vertex belongs to the sample nearest to it
/// along the edges of the mean head (a Voronoi diagram on the graph, by Dijkstra's algorithm from
/// all samples at once). Along the edges, so that the two lips stay apart however near they lie.
struct SampleCells {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> of_vertex;  ///< #V, index of the sample; kNone off the skin
};
SampleCells find_sample_cells(const Adjacency& adjacency, const Positions& mean,
                              const FaceSamples& samples);

/// What each sample stands for: the sum over its cell, divided by the sum over all cells.
/// \param areas  #V, not negative.
/// \throws InvalidInput if all are zero.
std::vector<double> sample_weights(const SampleCells& cells, const FaceSamples& samples,
                                   const std::vector<double>& areas);

/// The coarse mesh of the cells, which is to the skin what a Delaunay triangulation is to the plane:
/// where three cells meet, their samples form a triangle, wound like the mesh. Each once.
std::vector<std::array<std::uint32_t, 3>> cell_triangles(const Topology& topology,
                                                         const SampleCells& cells);

}  // namespace crowdface
