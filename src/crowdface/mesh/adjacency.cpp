// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/adjacency.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::size_t kBlock = 16384;

/// Both directions of all polygon edges, grouped by their first vertex. An edge occurs once in each
/// direction for every polygon that has it.
CompressedRows<std::uint32_t> half_edges_by_vertex(const Topology& topology) {
  return compressed_rows<std::uint32_t>(
      static_cast<std::size_t>(topology.vertex_count), [&](const auto& put) {
        for (Index f = 0; f < topology.face_count(); ++f) {
          const auto face = topology.face(f);
          for (std::size_t c = 0; c < face.size(); ++c) {
            const std::uint32_t a = face[c], b = face[(c + 1) % face.size()];
            if (a == b) continue;
            put(a, b);
            put(b, a);
          }
        }
      });
}

}  // namespace

Adjacency build_adjacency(const Topology& topology) {
  CompressedRows<std::uint32_t> all = half_edges_by_vertex(topology);
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  // If a neighbour occurs only once in the list of a vertex, the edge between the neighbour and the
  // vertex has one polygon.
  std::vector<std::uint8_t> on_boundary(vertices, 0);
  std::vector<std::size_t> kept(vertices, 0);
  parallel_for_each(vertices, kBlock, [&](std::size_t i) {
    const std::span<std::uint32_t> ring = all.items_of(i);
    std::ranges::sort(ring);
    for (auto run = ring.begin(); run != ring.end();) {
      const auto run_end = std::find_if(run, ring.end(), [&](auto n) { return n != *run; });
      if (run_end - run == 1) on_boundary[i] = 1;
      ring[kept[i]++] = *run;
      run = run_end;
    }
  });
  Adjacency result;
  result.boundary.assign(on_boundary.begin(), on_boundary.end());
  result.reserve(vertices, std::accumulate(kept.begin(), kept.end(), std::size_t{0}));
  for (std::size_t i = 0; i < vertices; ++i) result.add_group(all.items_of(i).first(kept[i]));
  return result;
}

std::uint32_t Components::largest() const {
  return static_cast<std::uint32_t>(std::ranges::max_element(sizes) - sizes.begin());
}

Components find_components(const Adjacency& adjacency) {
  Components components;
  components.component_of_vertex.assign(static_cast<std::size_t>(adjacency.vertex_count()),
                                        kNoIndex);
  std::vector<std::uint32_t> open;
  for (Index start = 0; start < adjacency.vertex_count(); ++start) {
    if (components.component_of_vertex[static_cast<std::size_t>(start)] != kNoIndex) continue;
    const auto id = static_cast<std::uint32_t>(components.sizes.size());
    components.sizes.push_back(0);
    open.push_back(static_cast<std::uint32_t>(start));
    components.component_of_vertex[static_cast<std::size_t>(start)] = id;
    while (!open.empty()) {
      const std::uint32_t vertex = open.back();
      open.pop_back();
      ++components.sizes[id];
      for (const std::uint32_t n : adjacency.items_of(vertex)) {
        if (components.component_of_vertex[n] != kNoIndex) continue;
        components.component_of_vertex[n] = id;
        open.push_back(n);
      }
    }
  }
  return components;
}

double rms_edge_length(const Adjacency& adjacency, const Components& components,
                       std::uint32_t component, const Positions& positions) {
  std::size_t edges = 0;
  double squares = 0;
  for (Index i = 0; i < adjacency.vertex_count(); ++i) {
    if (components.component_of_vertex[static_cast<std::size_t>(i)] != component) continue;
    for (const std::uint32_t n : adjacency.items_of(i)) {
      if (n <= i) continue;  // count each edge once
      const double x = positions(i, 0) - positions(n, 0);
      const double y = positions(i, 1) - positions(n, 1);
      const double z = positions(i, 2) - positions(n, 2);
      squares += x * x + y * y + z * z;
      ++edges;
    }
  }
  return edges == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(edges));
}

}  // namespace crowdface
