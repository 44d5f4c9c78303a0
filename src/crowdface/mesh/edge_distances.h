// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Shortest distances from source vertices along the edges of a mesh (Dijkstra 1959). One object
/// can run many searches. The time of a search depends on the number of vertices that the search
/// reaches.
class EdgeDistances {
 public:
  /// The adjacency and the positions must outlive this object.
  EdgeDistances(const Adjacency& adjacency, const Positions& positions);

  /// Finds all vertices whose distance from the nearest source is at most `limit`. Discards the
  /// results of the previous search.
  void search(std::span<const std::uint32_t> sources,
              double limit = std::numeric_limits<double>::infinity());

  /// Finds the distances from one source to the goals only, as far as they are at most `limit`.
  /// Skips vertices from which no goal can be reached within this limit.
  void search_for(std::uint32_t source, std::span<const std::uint32_t> goals, double limit);

  /// Distance from the nearest source to a vertex; infinite if the search did not reach the vertex.
  double distance(std::uint32_t vertex) const {
    return settled_[vertex] ? distances_[vertex] : std::numeric_limits<double>::infinity();
  }
  /// Index of the nearest source in the list of sources. If several sources are equally near,
  /// returns the first of these sources. Returns kNoIndex if the search did not reach the vertex.
  std::uint32_t nearest_source(std::uint32_t vertex) const {
    return settled_[vertex] ? sources_[vertex] : kNoIndex;
  }
  /// The vertices that the search reached, nearest first.
  const std::vector<std::uint32_t>& reached() const { return reached_; }

 private:
  using QueueEntry = std::tuple<double, std::uint32_t, std::uint32_t>;  // distance, source, vertex

  /// Discards the results of the previous search and puts the sources into the queue.
  void begin(std::span<const std::uint32_t> sources);
  /// Main loop of the search: makes the distances of vertices final, nearest vertex first, until
  /// the queue is empty or `is_done` returns true for a final vertex.
  /// \param continues_from  called with a distance and a vertex; returns whether the search
  ///                        continues from this vertex.
  template <class ContinuesFrom, class IsDone>
  void settle(const ContinuesFrom& continues_from, const IsDone& is_done);

  const Adjacency& adjacency_;
  const Positions& positions_;
  /// smallest distance found so far for each vertex; final when the vertex is settled
  std::vector<double> distances_;
  /// for each vertex, the nearest source found so far, as an index into the list of sources
  std::vector<std::uint32_t> sources_;
  std::vector<std::uint32_t> reached_;  ///< indices of the settled vertices, nearest first
  std::vector<std::uint32_t> touched_;  ///< indices of the vertices whose distance is finite
  std::vector<bool> settled_;           ///< #V: whether the distance is final
  /// heap of the vertices to visit; the nearest vertex comes first
  std::vector<QueueEntry> queue_;
};

/// For each vertex, the index in `sources` of the nearest source; kNoIndex if no source is
/// connected to the vertex. Distances are measured along the edges. If several sources are equally
/// near, the result is the source whose path the search finds first, which is deterministic.
/// Surfaces that almost touch, such as the lips, are far apart along the edges.
std::vector<std::uint32_t> nearest_along_edges(const Adjacency& adjacency,
                                               const Positions& positions,
                                               std::span<const std::uint32_t> sources);

}  // namespace crowdface
