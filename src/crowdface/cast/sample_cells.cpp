// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/sample_cells.h"

#include <algorithm>
#include <set>

#include "crowdface/core/error.h"
#include "crowdface/mesh/edge_distances.h"

namespace crowdface {

SampleCells find_sample_cells(const Adjacency& adjacency, const Positions& mean,
                              const FaceSamples& samples) {
  EdgeDistances distances(adjacency, mean);
  distances.search(samples);
  SampleCells cells;
  for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(adjacency.vertex_count()); ++v) {
    cells.sample_of_vertex.push_back(distances.nearest_source(v));
  }
  return cells;
}

std::vector<double> sample_weights(const SampleCells& cells, const FaceSamples& samples,
                                   const std::vector<double>& areas) {
  std::vector<double> weights(samples.size(), 0.0);
  double total = 0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    if (cells.sample_of_vertex[v] == SampleCells::kNone) continue;
    weights[cells.sample_of_vertex[v]] += areas[v];
    total += areas[v];
  }
  if (!(total > 0)) {
    throw InvalidInput(
        "distance: expected skin with a weight above 0, found none; change distance.mask or "
        "distance.area");
  }
  for (double& weight : weights) weight /= total;
  return weights;
}

std::vector<std::array<std::uint32_t, 3>> cell_triangles(const Topology& topology,
                                                         const SampleCells& cells) {
  std::set<std::array<std::uint32_t, 3>> seen;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> ring;
  for (Index f = 0; f < topology.face_count(); ++f) {
    ring.clear();
    for (const std::uint32_t v : topology.face(f)) {
      const std::uint32_t cell = cells.sample_of_vertex[v];
      if (cell == SampleCells::kNone) continue;
      if (std::find(ring.begin(), ring.end(), cell) == ring.end()) ring.push_back(cell);
    }
    for (std::size_t c = 2; c < ring.size(); ++c) {
      const std::array<std::uint32_t, 3> triangle = {ring[0], ring[c - 1], ring[c]};
      std::array<std::uint32_t, 3> key = triangle;
      std::sort(key.begin(), key.end());
      if (seen.insert(key).second) triangles.push_back(triangle);
    }
  }
  return triangles;
}

}  // namespace crowdface
