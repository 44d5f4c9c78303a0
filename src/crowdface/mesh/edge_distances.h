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

/// How far vertices are from some others along the edges of a mesh (Dijkstra 1959). One object serves
/// many searches; each costs what it reaches.
class EdgeDistances {
 public:
  /// Both must outlive it.
  EdgeDistances(const Adjacency& adjacency, const Positions& positions);

  /// Looks as far as `limit` around some vertices, forgetting what was found before.
  void search(std::span<const std::uint32_t> sources,
              double limit = std::numeric_limits<double>::infinity());

  /// The same from one vertex, for the distances of some others alone: it leaves out what no way to them
  /// that keeps the limit can pass, and ends when it has reached all of them.
  void search_for(std::uint32_t source, std::span<const std::uint32_t> goals, double limit);

  /// Of a vertex from the nearest source; infinite if it was not reached.
  double distance(std::uint32_t vertex) const {
    return settled_[vertex] ? distances_[vertex] : std::numeric_limits<double>::infinity();
  }
  /// Which of the sources is nearest, of equally near ones the first; kNoIndex if none reached it.
  std::uint32_t source(std::uint32_t vertex) const {
    return settled_[vertex] ? sources_[vertex] : kNoIndex;
  }
  /// Nearest first.
  const std::vector<std::uint32_t>& reached() const { return reached_; }

 private:
  using Open = std::tuple<double, std::uint32_t, std::uint32_t>;  // distance, source, vertex

  void begin(std::span<const std::uint32_t> sources);
  /// Settles what is nearest until nothing is open or `settled` says that it is enough.
  /// \param may_lead  of a distance and the vertex there: whether to go on from there.
  template <class MayLead, class Settled>
  void spread(const MayLead& may_lead, const Settled& settled);

  const Adjacency& adjacency_;
  const Positions& positions_;
  std::vector<double> distances_;  ///< the least that is known; of those reached, the least
  std::vector<std::uint32_t> sources_, reached_, touched_;
  std::vector<bool> settled_;
  std::vector<Open> open_;  ///< a heap, the nearest first
};

/// For each vertex which of some vertices is nearest along the edges, #V; of equally near ones the one that comes
/// there first. kNoIndex where none is joined. Surfaces that nearly touch are far apart so.
std::vector<std::uint32_t> nearest_along_edges(const Adjacency& adjacency,
                                               const Positions& positions,
                                               std::span<const std::uint32_t> sources);

}  // namespace crowdface
