// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/sample_cells.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>
#include <tuple>

#include "crowdface/core/error.h"

namespace crowdface {
namespace {

/// A vertex reached from a sample; of equally near samples the first.
using Reached = std::tuple<double, std::uint32_t, std::uint32_t>;  // distance, sample, vertex

}  // namespace

SampleCells find_sample_cells(const Adjacency& adjacency, const Positions& mean,
                              const FaceSamples& samples) {
  SampleCells cells;
  cells.of_vertex.assign(static_cast<std::size_t>(adjacency.vertex_count()), SampleCells::kNone);
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    open.emplace(0.0, static_cast<std::uint32_t>(s), samples[s]);
  }
  while (!open.empty()) {
    const auto [distance, sample, vertex] = open.top();
    open.pop();
    if (cells.of_vertex[vertex] != SampleCells::kNone) continue;
    cells.of_vertex[vertex] = sample;
    for (const std::uint32_t next : adjacency.of(vertex)) {
      if (cells.of_vertex[next] != SampleCells::kNone) continue;
      double squared = 0;
      for (int c = 0; c < 3; ++c) {
        const double d = mean(next, c) - mean(vertex, c);
        squared += d * d;
      }
      open.emplace(distance + std::sqrt(squared), sample, next);
    }
  }
  return cells;
}

std::vector<double> sample_weights(const SampleCells& cells, const FaceSamples& samples,
                                   const std::vector<double>& areas) {
  std::vector<double> weights(samples.size(), 0.0);
  double total = 0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    if (cells.of_vertex[v] == SampleCells::kNone) continue;
    weights[cells.of_vertex[v]] += areas[v];
    total += areas[v];
  }
  if (!(total > 0)) {
    throw InvalidInput("faces cannot be compared: the area that counts is empty");
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
      const std::uint32_t cell = cells.of_vertex[v];
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
