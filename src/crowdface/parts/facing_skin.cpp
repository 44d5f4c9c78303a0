// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/facing_skin.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_set>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/proximity_joiner.h"
#include "crowdface/smooth/symmetric_eigen.h"

namespace crowdface {
namespace {

// Lengths are fractions of the skin's extent, about 43 cm.
constexpr double kReach = 0.008;    // largest distance between vertices of skin that nearly touches
constexpr double kSpacing = 0.003;  // spacing of the subsampled vertices
// Largest overlap of facing skin, as a fraction of the skin's extent. An overlap is allowed because
// touching lips overlap a little on the mean head. The limit is less than the thickness of an
// eyelid.
constexpr double kOverlap = 0.0005;
constexpr double kMinSidewaysGap =
    0.0035;  // the test of kSideways replaces smaller gaps by this gap
constexpr double kMinSurfaceDistance = 0.02;  // smallest distance along the surface
// Pairs whose midpoints are at most this fraction of the skin's extent apart belong to the same
// group; kGroupDistanceInEdges is the limit for a coarse mesh.
constexpr double kGroupDistance = 0.015;
// smallest distance of a pair's vertices along the surface, as a multiple of their distance in
// space
constexpr double kMinSurfaceRatio = 3;
constexpr double kMaxNormalCosine = -0.3;  // largest cosine between the normals
constexpr double kGroupDistanceInEdges =
    2.5;                            // the limit kGroupDistance in a coarse mesh, in edge lengths
constexpr double kSideways = 0.75;  // largest sideways offset, as a fraction of the gap
/// kBlock: smallest number of vertices in a parallel block. kSearches: largest number of blocks
/// that search along the surface.
constexpr Index kBlock = 1024, kSearches = 16;

/// Thins out the vertices of the skin: of all skin vertices in a cell of a grid, returns only the
/// vertex with the lowest index. The result is in ascending order. `width` is the edge length of a
/// cell.
std::vector<std::uint32_t> thinned(const Positions& positions, std::span<const std::uint32_t> skin,
                                   double width) {
  using Cell = std::array<double, 3>;
  const auto mixed = [](const Cell& cell) {
    std::uint64_t bits = 0;
    for (const double at : cell) {
      // Adding zero turns −0 into +0: the two compare equal, so they need the same hash.
      bits = (bits ^ std::bit_cast<std::uint64_t>(at + 0.0)) * 0x9e3779b97f4a7c15ULL;
      bits ^= bits >> 32U;
    }
    return static_cast<std::size_t>(bits);
  };
  std::unordered_set<Cell, decltype(mixed)> taken(0, mixed);
  std::vector<std::uint32_t> first;
  for (const std::uint32_t v : skin) {
    Cell cell;
    for (Index c = 0; c < 3; ++c) {
      cell[static_cast<std::size_t>(c)] = std::floor(positions(v, c) / width);
    }
    if (taken.insert(cell).second) first.push_back(v);
  }
  return first;
}

/// Returns 1 if the normals of a mesh point outwards, −1 if they point inwards.
double outward_side(const Positions& positions, const Positions& normals,
                    std::span<const std::uint32_t> skin) {
  const Eigen::Vector3d middle = centre_of(positions, skin);
  double volume = 0;
  for (const std::uint32_t v : skin) {
    volume += (row3(positions, v) - middle).dot(row3(normals, v));
  }
  return volume < 0 ? -1 : 1;
}

struct Candidate {
  double distance;
  std::uint32_t vertex;
  Eigen::Vector3d across;
};

/// Returns the vertices that may face a given vertex, nearest first.
std::vector<Candidate> facing_candidates(const Positions& positions, const Positions& normals,
                                         double side, const PointGrid& grid, std::uint32_t v,
                                         double extent) {
  const Eigen::Vector3d here = positions.row(v).transpose(), normal = normals.row(v).transpose();
  std::vector<Candidate> found;
  for (const std::uint32_t w : grid.vertices_near(here, kReach * extent)) {
    const Eigen::Vector3d other = normals.row(w).transpose();
    if (normal.dot(other) > kMaxNormalCosine) continue;
    const Eigen::Vector3d from = positions.row(w).transpose() - here;
    const double distance = from.norm();
    if (distance > kReach * extent) continue;
    const Eigen::Vector3d across = side * (normal - other).normalized();
    const double gap = from.dot(across);
    const double aside = (from - gap * across).norm();
    if (gap < -kOverlap * extent || aside > kSideways * std::max(gap, kMinSidewaysGap * extent))
      continue;
    found.push_back({distance, w, across});
  }
  std::ranges::sort(found, [](const Candidate& a, const Candidate& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.vertex < b.vertex;
  });
  return found;
}

/// Swaps the two vertices of some pairs, so that FacingPair::low_vertex of all pairs of a group
/// lies on the same side of the gap, such as the lower lip.
void agree_on_sides(FacingGroup& group) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const FacingPair& pair : group) spread += pair.up * pair.up.transpose();
  const Eigen::Vector3d up = symmetric_eigen(spread).eigenvectors.col(0);
  for (FacingPair& pair : group) {
    if (pair.up.dot(up) >= 0) continue;
    std::swap(pair.low_vertex, pair.high_vertex);
    pair.up = -pair.up;
  }
}

/// Returns the mean length of the mesh edges that end at the low vertices of the pairs (see
/// FacingPair).
double mean_edge(const Adjacency& adjacency, const Positions& positions, const FacingGroup& pairs) {
  double sum = 0, count = 0;
  for (const FacingPair& pair : pairs) {
    for (const std::uint32_t n : adjacency.items_of(pair.low_vertex)) {
      sum += (row3(positions, n) - row3(positions, pair.low_vertex)).norm();
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

/// Groups the pairs: pairs whose midpoints are at most `reach` apart are in the same group.
std::vector<FacingGroup> group_facing_pairs(const FacingGroup& pairs, double reach) {
  if (pairs.empty()) return {};
  Positions middles(static_cast<Index>(pairs.size()), 3);
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    middles.row(i) = pairs[i].middle.transpose();
    rows.push_back(i);
  }
  DisjointSets grouping(pairs.size());
  ProximityJoiner tree(middles, rows, rows, grouping);
  for (const std::uint32_t i : rows) tree.join_near(pairs[i].middle, reach, i);
  std::map<std::uint32_t, FacingGroup> by_root;
  for (const std::uint32_t i : rows) by_root[grouping.root(i)].push_back(pairs[i]);
  std::vector<FacingGroup> groups;
  for (auto& [root, group] : by_root) {
    agree_on_sides(group);
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

std::vector<FacingGroup> find_facing_skin(const Topology& topology, const Adjacency& adjacency,
                                          const Positions& positions,
                                          std::span<const std::uint32_t> skin) {
  const double extent = extent_of(positions, skin);
  if (!(extent > 0)) return {};
  const Positions normals = vertex_normals(topology, positions);
  const double side = outward_side(positions, normals, skin);
  const std::vector<std::uint32_t> some = thinned(positions, skin, kSpacing * extent);
  const PointGrid grid(positions, some);
  std::vector<std::vector<Candidate>> candidates(some.size());
  parallel_for_each(some.size(), kBlock, [&](std::size_t i) {
    // Find near vertices whose normals are opposite to the normal of vertex some[i].
    candidates[i] = facing_candidates(positions, normals, side, grid, some[i], extent);
  });

  std::vector<std::optional<FacingPair>> found(some.size());
  const auto count = static_cast<Index>(some.size());
  // Use few blocks, because each block allocates arrays for the whole mesh.
  parallel_blocks(count, std::max(kBlock, count / kSearches), [&](Index begin, Index end) {
    EdgeDistances along(adjacency, positions);
    std::vector<std::uint32_t> goals;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      if (candidates[i].empty()) continue;
      throw_if_interrupted();
      goals.clear();
      for (const Candidate& candidate : candidates[i]) goals.push_back(candidate.vertex);
      // Consider only candidates that are far away along the surface. Keep the candidate that is
      // nearest in space.
      along.search_for(
          some[i], goals,
          std::max(kMinSurfaceRatio * candidates[i].back().distance, kMinSurfaceDistance * extent));
      for (const Candidate& candidate : candidates[i]) {
        const double least =
            std::max(kMinSurfaceRatio * candidate.distance, kMinSurfaceDistance * extent);
        if (along.distance(candidate.vertex) <= least) continue;
        found[i] = {some[i], candidate.vertex,
                    (positions.row(some[i]) + positions.row(candidate.vertex)).transpose() / 2,
                    candidate.across};
        break;
      }
    }
  });
  FacingGroup pairs;
  for (const auto& pair : found) {
    if (pair) pairs.push_back(*pair);
  }
  return group_facing_pairs(
      pairs, std::max(kGroupDistance * extent,
                      kGroupDistanceInEdges * mean_edge(adjacency, positions, pairs)));
}

}  // namespace crowdface
