// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/adjacency.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr Index kBlock = 16384;

/// Both directions of every face's edges, grouped by their first vertex: with repetitions, one for
/// each face at the edge.
Adjacency half_edges_by_vertex(const Topology& topology) {
  Adjacency all;
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  all.offsets.assign(vertices + 1, 0);
  const auto for_each_edge = [&](auto&& visit) {
    for (Index f = 0; f < topology.face_count(); ++f) {
      const auto face = topology.face(f);
      for (std::size_t c = 0; c < face.size(); ++c) {
        const std::uint32_t a = face[c], b = face[(c + 1) % face.size()];
        if (a != b) visit(a, b);
      }
    }
  };
  for_each_edge([&](std::uint32_t a, std::uint32_t b) {
    ++all.offsets[a + 1];
    ++all.offsets[b + 1];
  });
  for (std::size_t i = 0; i < vertices; ++i) all.offsets[i + 1] += all.offsets[i];
  all.neighbours.resize(all.offsets.back());
  std::vector<std::uint32_t> next(all.offsets.begin(), all.offsets.end() - 1);
  for_each_edge([&](std::uint32_t a, std::uint32_t b) {
    all.neighbours[next[a]++] = b;
    all.neighbours[next[b]++] = a;
  });
  return all;
}

}  // namespace

Adjacency build_adjacency(const Topology& topology) {
  Adjacency all = half_edges_by_vertex(topology);
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  // A neighbour met once belongs to an edge with one face.
  std::vector<std::uint8_t> on_boundary(vertices, 0);
  std::vector<std::uint32_t> kept(vertices, 0);
  parallel_blocks(topology.vertex_count, kBlock, [&](Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const auto first = all.neighbours.begin() + all.offsets[i];
      const auto last = all.neighbours.begin() + all.offsets[i + 1];
      std::sort(first, last);
      auto out = first;
      for (auto run = first; run != last;) {
        const auto run_end = std::find_if(run, last, [&](std::uint32_t n) { return n != *run; });
        if (run_end - run == 1) on_boundary[i] = 1;
        *out++ = *run;
        run = run_end;
      }
      kept[i] = static_cast<std::uint32_t>(out - first);
    }
  });
  Adjacency result;
  result.boundary.assign(on_boundary.begin(), on_boundary.end());
  result.offsets.assign(vertices + 1, 0);
  for (std::size_t i = 0; i < vertices; ++i) result.offsets[i + 1] = result.offsets[i] + kept[i];
  result.neighbours.resize(result.offsets.back());
  for (std::size_t i = 0; i < vertices; ++i) {
    std::copy_n(all.neighbours.begin() + all.offsets[i], kept[i],
                result.neighbours.begin() + result.offsets[i]);
  }
  return result;
}

std::uint32_t Components::largest() const {
  return static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
}

Components find_components(const Adjacency& adjacency) {
  Components components;
  components.of_vertex.assign(static_cast<std::size_t>(adjacency.vertex_count()), kNoIndex);
  std::vector<std::uint32_t> open;
  for (Index start = 0; start < adjacency.vertex_count(); ++start) {
    if (components.of_vertex[static_cast<std::size_t>(start)] != kNoIndex) continue;
    const auto id = static_cast<std::uint32_t>(components.sizes.size());
    components.sizes.push_back(0);
    open.push_back(static_cast<std::uint32_t>(start));
    components.of_vertex[static_cast<std::size_t>(start)] = id;
    while (!open.empty()) {
      const std::uint32_t vertex = open.back();
      open.pop_back();
      ++components.sizes[id];
      for (const std::uint32_t n : adjacency.of(vertex)) {
        if (components.of_vertex[n] != kNoIndex) continue;
        components.of_vertex[n] = id;
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
    if (components.of_vertex[static_cast<std::size_t>(i)] != component) continue;
    for (const std::uint32_t n : adjacency.of(i)) {
      if (n <= i) continue;  // each edge once
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
