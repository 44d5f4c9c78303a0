// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/cast/face_samples.h"

namespace crowdface {

/// A partition of the skin into cells around the samples. Each vertex belongs to the sample that is
/// nearest along the edges of the mean head (a Voronoi diagram on the graph, by Dijkstra's
/// algorithm from all samples at once). Distances along edges keep the upper and lower lip in
/// different cells, even where the lips touch.
struct SampleCells {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> sample_of_vertex;  ///< #V: index of the sample; kNone outside the skin
};
SampleCells find_sample_cells(const Adjacency& adjacency, const Positions& mean,
                              const FaceSamples& samples);

/// Returns the weight of each sample: the area of its cell, divided by the area of all cells.
///
/// \param areas  #V; not negative.
/// \throws InvalidInput if all are zero.
std::vector<double> sample_weights(const SampleCells& cells, const FaceSamples& samples,
                                   const std::vector<double>& areas);

/// Returns the coarse mesh of the cells, an analogue of the Delaunay triangulation: three samples
/// whose cells meet form a triangle with the mesh's winding. No triangle appears twice.
std::vector<std::array<std::uint32_t, 3>> cell_triangles(const Topology& topology,
                                                         const SampleCells& cells);

}  // namespace crowdface
