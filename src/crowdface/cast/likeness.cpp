// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/likeness.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "crowdface/cast/nearest_face_search.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::size_t kBlock = 64;

/// A set of faces with queries for the most similar faces. The caller may remove faces. Results are
/// exact: they use FaceSpace::distance over all remaining faces. Equally near faces are sorted by
/// index.
class LikenessTree {
 public:
  /// \param points  Must outlive this object.
  /// \param gone    One entry per point: true if the face is removed, so that queries ignore the
  ///                face. The caller may set entries to true later. Must outlive this object.
  LikenessTree(const std::vector<FaceSpace::Point>& points, const std::vector<bool>& gone)
      : points_(points), gone_(gone) {
    add_variant(&FaceSpace::Point::coordinates_with_extrapolation);
    if (std::any_of(points.begin(), points.end(), [](const FaceSpace::Point& point) {
          return point.coordinates_with_extrapolation != point.coordinates_without_extrapolation;
        })) {
      add_variant(&FaceSpace::Point::coordinates_without_extrapolation);
    }
  }

  std::size_t size() const { return static_cast<std::size_t>(blocks().size()); }
  /// Returns the face at a position in the tree. Faces at neighbouring positions are similar, so
  /// queries in this order use the cache well.
  std::size_t face(std::size_t place) const {
    return static_cast<std::size_t>(blocks().point_number(static_cast<Index>(place)));
  }

  /// Returns the `count` faces nearest to `face`, beginning with the nearest. Ignores `face` itself
  /// and the faces that are marked in `gone_`.
  std::vector<Neighbour> nearest(std::size_t face, std::size_t count) const {
    std::vector<Neighbour> near;
    if (count == 0) return near;
    near.reserve(count + 1);
    float bound = HUGE_VALF;  // faces with a larger squared distance are skipped
    const auto meet = [&](std::size_t other) {
      if (gone_[other] || other == face || contains_face(near, other)) return;
      const Neighbour found{other, FaceSpace::distance(points_[face], points_[other])};
      near.insert(std::upper_bound(near.begin(), near.end(), found, nearer), found);
      if (near.size() > count) near.pop_back();
      if (near.size() < count) return;
      bound = static_cast<float>(near.back().distance_mm * near.back().distance_mm *
                                 (1 + PointBlocks::kRoundingTolerance));
    };
    for (const auto& [of, tree] : variants_) {
      const PointBlocks& points = tree.points();
      const std::vector<float> query = points.padded_query(points_[face].*of);
      const auto wanted = [&](float squared, const auto&) { return squared <= bound; };
      tree.visit(query, wanted, [&](Index block) {
        const auto squared = points.squared_distances(query, block, bound);
        if (!squared) return;
        const Index first = block * PointBlocks::kLanes;
        const Index last = std::min(PointBlocks::kLanes, points.size() - first);
        for (Index lane = 0; lane < last; ++lane) {
          if ((*squared)[static_cast<std::size_t>(lane)] > bound) continue;
          meet(static_cast<std::size_t>(points.point_number(first + lane)));
        }
      });
    }
    return near;
  }

 private:
  using Variant = Eigen::VectorXf FaceSpace::Point::*;

  static bool nearer(const Neighbour& a, const Neighbour& b) {
    return a.distance_mm != b.distance_mm ? a.distance_mm < b.distance_mm : a.face < b.face;
  }
  static bool contains_face(const std::vector<Neighbour>& near, std::size_t face) {
    return std::ranges::find(near, face, &Neighbour::face) != near.end();
  }
  const PointBlocks& blocks() const { return variants_.front().second.points(); }

  /// Adds a tree over one variant of the points (with or without extrapolation).
  void add_variant(Variant of) {
    const Index dimensions = (points_[0].*of).size();
    PointBlocks blocks(dimensions);
    for (std::size_t face = 0; face < points_.size(); ++face) {
      if (gone_[face]) continue;
      blocks.add(static_cast<Index>(face), blocks.padded_query(points_[face].*of).data());
    }
    variants_.emplace_back(of, PointTree(dimensions, {&blocks}));
  }

  const std::vector<FaceSpace::Point>& points_;
  const std::vector<bool>& gone_;
  /// The first tree contains the points with extrapolation. If any face is extrapolated, a second
  /// tree contains the points without extrapolation.
  std::vector<std::pair<Variant, PointTree>> variants_;
};

/// Returns the face that is farthest from face 0; of equally far faces, the first.
std::size_t farthest_from_first(const std::vector<FaceSpace::Point>& points) {
  std::vector<double> mm(points.size());
  parallel_for_each(points.size(), 16 * kBlock, [&](std::size_t other) {
    mm[other] = FaceSpace::distance(points[0], points[other]);
  });
  return static_cast<std::size_t>(std::max_element(mm.begin(), mm.end()) - mm.begin());
}

/// Visits all faces, always going to the nearest face that is not yet visited; see find_likeness.
///
/// \param near  For each face, its nearest faces. Every face that is not listed is farther away.
std::vector<std::size_t> nearest_neighbour_walk(const std::vector<FaceSpace::Point>& points,
                                                const std::vector<std::vector<Neighbour>>& near) {
  std::vector<bool> gone(points.size(), false);
  // contains the faces that were not yet visited when the tree was built
  std::optional<LikenessTree> tree;
  std::vector<std::size_t> order = {farthest_from_first(points)};
  while (true) {
    throw_if_interrupted();
    const std::size_t at = order.back();
    gone[at] = true;
    const std::size_t left = points.size() - order.size();
    if (left == 0) return order;
    const auto next = std::find_if(near[at].begin(), near[at].end(),
                                   [&](const Neighbour& other) { return !gone[other.face]; });
    if (next != near[at].end()) {
      order.push_back(next->face);
      continue;
    }
    if (!tree || left < tree->size() / 2) tree.emplace(points, gone);
    order.push_back(tree->nearest(at, 1).front().face);
  }
}

}  // namespace

Likeness find_likeness(const std::vector<FaceSpace::Point>& points, std::size_t neighbour_count) {
  Likeness likeness;
  if (points.empty()) return likeness;
  const std::vector<bool> none_gone(points.size(), false);
  const LikenessTree tree(points, none_gone);
  likeness.neighbours.resize(points.size());
  parallel_for_each(points.size(), kBlock, [&](std::size_t place) {
    const std::size_t face = tree.face(place);
    likeness.neighbours[face] = tree.nearest(face, neighbour_count);
  });
  likeness.face_order = nearest_neighbour_walk(points, likeness.neighbours);
  return likeness;
}

}  // namespace crowdface
