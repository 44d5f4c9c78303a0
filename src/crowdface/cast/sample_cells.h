// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/cast/face_samples.h"

namespace crowdface {

/// A partition of the skin into cells, one around each sample. Each vertex belongs to the sample
/// that is nearest along the edges of the mean head (a Voronoi diagram on the graph of edges, by
/// Dijkstra's algorithm from all samples at once). Distances along edges keep the upper and the
/// lower lip in different cells, even where the lips touch.
struct SampleCells {
  /// marks a vertex outside the skin, which belongs to no cell
  static constexpr std::uint32_t kNone = 0xffffffffU;
  /// for each vertex, the index of the sample whose cell contains the vertex; kNone outside the
  /// skin
  std::vector<std::uint32_t> sample_of_vertex;
};
SampleCells find_sample_cells(const Adjacency& adjacency, const Positions& mean,
                              const FaceSamples& samples);

/// Returns the weight of each sample: the area of the sample's cell, divided by the total area of
/// all cells.
///
/// \param areas  the area of each vertex; not negative.
/// \throws InvalidInput if all areas are zero.
std::vector<double> sample_weights(const SampleCells& cells, const FaceSamples& samples,
                                   const std::vector<double>& areas);

/// Returns the coarse mesh whose vertices are the samples, an analogue of the Delaunay
/// triangulation: three samples form a triangle if their cells meet. Triangles have the mesh's
/// winding. No triangle appears twice.
std::vector<std::array<std::uint32_t, 3>> cell_triangles(const Topology& topology,
                                                         const SampleCells& cells);

}  // namespace crowdface
