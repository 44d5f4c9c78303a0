// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
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

  /// Of a vertex from the nearest source; infinite if it was not reached.
  double distance(std::uint32_t vertex) const { return distances_[vertex]; }
  /// Which of the sources is nearest, of equally near ones the first; kNoIndex if none reached it.
  std::uint32_t source(std::uint32_t vertex) const { return sources_[vertex]; }
  /// Nearest first.
  const std::vector<std::uint32_t>& reached() const { return reached_; }

 private:
  const Adjacency& adjacency_;
  const Positions& positions_;
  std::vector<double> distances_;
  std::vector<std::uint32_t> sources_, reached_;
};

}  // namespace crowdface
