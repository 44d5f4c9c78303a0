// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/crossing_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "crowdface/mesh/all_columns.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/validity/triangle_scene.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {
namespace {

/// Two triangles that are at most kSheetRings edges apart are tested for intersection only if the
/// cosine between their normals is at most kSimilarNormalCosine, because a surface that is not
/// folded does not intersect itself.
constexpr int kSheetRings = 3;
constexpr float kSimilarNormalCosine = 0.998F;

/// Upper limit of the search distances `max_distance` and `max_facing_distance`. The unit is the
/// mean diagonal of the bounding boxes of the tree's leaves. On a dense mesh, leaves are small;
/// larger distances would give too many pairs of leaves.
constexpr double kMaxDistanceInLeaves = 3;

/// Bit mask (see LeafPair) with one bit for each pair of two different triangles of the same leaf.
constexpr std::uint64_t kEachPairOnce = [] {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < LeafBoxes::kMaxTriangles; ++i) {
    for (std::size_t j = i + 1; j < LeafBoxes::kMaxTriangles; ++j) {
      bits |= std::uint64_t{1} << (LeafBoxes::kMaxTriangles * i + j);
    }
  }
  return bits;
}();

/// Finds the triangles that are a few edges away from a given triangle.
class Rings {
 public:
  Rings(const std::vector<Triangle>& triangles, Index vertex_count)
      : triangles_(triangles),
        around_(topology_of(triangles, vertex_count)),
        seen_(triangles.size(), kNoIndex) {}

  /// Returns the triangles within kSheetRings edges, including `from`.
  std::span<const std::uint32_t> triangles_near(std::uint32_t from) {
    reached_ = {from};
    seen_[from] = from;
    std::size_t begin = 0;
    for (int ring = 0; ring < kSheetRings; ++ring) {
      const std::size_t end = reached_.size();
      for (; begin < end; ++begin) {
        for (const std::uint32_t v : triangles_[reached_[begin]]) {
          for (const std::uint32_t other : around_.items_of(v)) {
            if (seen_[other] == from) continue;
            seen_[other] = from;
            reached_.push_back(other);
          }
        }
      }
    }
    return reached_;
  }

 private:
  const std::vector<Triangle>& triangles_;
  VertexFaces around_;
  /// for each triangle: start triangle of the last search that reached this triangle
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint32_t> reached_;
};

/// Returns the mean diagonal of the leaves' bounding boxes.
double mean_leaf_size(const TriangleTree& tree, const FloatPositions& points) {
  double sum = 0;
  for (const LeafCorners& corners : tree.corners) {
    const Box box = LeafBoxes(corners, points, 0).bounding_box();
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double side = static_cast<double>(box.high[c]) - static_cast<double>(box.low[c]);
      square += side * side;
    }
    sum += std::sqrt(square);
  }
  return tree.corners.empty() ? 0 : sum / static_cast<double>(tree.corners.size());
}

}  // namespace

CrossingSearch::CrossingSearch(std::vector<Triangle> triangles, const Positions& mesh,
                               double max_distance, double max_facing_distance)
    : triangles_(std::move(triangles)) {
  for (const Triangle& t : triangles_) vertices_.insert(vertices_.end(), t.begin(), t.end());
  std::ranges::sort(vertices_);
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  std::vector<Triangle> numbered = triangles_;
  for (Triangle& triangle : numbered) {
    for (std::uint32_t& v : triangle) v = index_in_list(vertices_, v);
  }
  const Positions points = mesh(vertices_, kAllColumns);
  tree_ = TriangleTree(numbered, points, max_distance);
  find_leaf_pairs(numbered, points, max_distance, max_facing_distance);
}

void CrossingSearch::find_leaf_pairs(const std::vector<Triangle>& numbered, const Positions& points,
                                     double max_distance, double max_facing_distance) {
  const FloatPositions single = points.cast<float>();
  const double most = kMaxDistanceInLeaves * mean_leaf_size(tree_, single);
  max_distance = std::min(max_distance, most);
  max_facing_distance = std::min(max_facing_distance, most);
  const TriangleScene scene(numbered, tree_, points, max_facing_distance / 2);
  std::vector<LeafBoxes> close, far;
  std::vector<LeafNormals> normals;
  for (const LeafCorners& corners : tree_.corners) {
    close.emplace_back(corners, single, max_distance / 2);
    far.emplace_back(corners, single, max_facing_distance / 2);
    normals.emplace_back(corners, single);
  }
  // for each triangle: its index in the order of the leaves; kNoIndex if no leaf contains it
  std::vector<std::uint32_t> place(numbered.size(), kNoIndex);
  for (std::uint32_t i = 0; i < tree_.order.size(); ++i) place[tree_.order[i]] = i;
  Rings rings(numbered, points.rows());
  // Two bit masks for each leaf of the tree. A bit stands for a pair of triangles: one triangle of
  // leaf `one` and one triangle of the mask's leaf. The first mask marks the pairs that are a few
  // edges apart; the second mask marks the pairs with a common vertex.
  std::vector<std::array<std::uint64_t, 2>> masks_of_leaf(tree_.leaf_count());
  for (std::uint32_t one = 0; one < tree_.leaf_count(); ++one) {
    const std::vector<std::uint32_t> others = scene.leaves_near(one);
    for (const std::uint32_t other : others) masks_of_leaf[other] = {0, 0};
    const auto ones = tree_.leaf(one);
    // For each triangle of leaf `one`, mark the triangles that are at most kSheetRings edges away.
    for (std::size_t k = 0; k < ones.size(); ++k) {
      for (const std::uint32_t other : rings.triangles_near(ones[k])) {
        if (place[other] == kNoIndex) continue;
        const std::uint64_t bit = std::uint64_t{1} << (LeafBoxes::kMaxTriangles * k +
                                                       place[other] % LeafBoxes::kMaxTriangles);
        auto& [few_edges, joined] = masks_of_leaf[place[other] / LeafBoxes::kMaxTriangles];
        few_edges |= bit;
        if (share_vertex(numbered[ones[k]], numbered[other])) joined |= bit;
      }
    }
    for (const std::uint32_t other : others) {
      const auto& [few_edges, joined] = masks_of_leaf[other];
      // Find the candidate pairs of triangles in each pair of leaves.
      const std::uint64_t once = one == other ? kEachPairOnce : ~std::uint64_t{0};
      std::uint64_t facing_it = overlap_mask(far[one], far[other]);
      if (facing_it != 0) facing_it &= ~similar_normal_mask(normals[one], normals[other], 0);
      const std::uint64_t near = overlap_mask(close[one], close[other]) & once;
      const std::uint64_t always = (near | (facing_it & once)) & ~few_edges;
      const std::uint64_t folded = near & few_edges & ~joined;
      if ((always | folded) != 0) leaf_pairs_.push_back({one, other, always, folded});
    }
  }
}

void CrossingSearch::measure_leaf(std::size_t l, Boxes& boxes) const {
  boxes.triangle_boxes[l] = LeafBoxes(tree_.corners[l], boxes.points, 0);
  boxes.leaf_boxes[l] = boxes.triangle_boxes[l].bounding_box();
  boxes.leaf_normals[l] = LeafNormals(tree_.corners[l], boxes.points);
}

CrossingSearch::Boxes CrossingSearch::make_boxes(const Positions& mesh) const {
  const std::size_t leaves = tree_.leaf_count();
  Boxes boxes{mesh(vertices_, kAllColumns).cast<float>(), std::vector<LeafBoxes>(leaves),
              std::vector<LeafNormals>(leaves), std::vector<Box>(leaves),
              std::vector<std::uint8_t>(leaves, 1)};
  for (std::size_t l = 0; l < leaves; ++l) measure_leaf(l, boxes);
  return boxes;
}

void CrossingSearch::update(const Positions& mesh, const std::vector<bool>& changed,
                            Boxes& boxes) const {
  std::vector<std::uint8_t> moved(vertices_.size(), 0);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (!changed[vertices_[i]]) continue;
    moved[i] = 1;
    boxes.points.row(static_cast<Index>(i)) = mesh.row(vertices_[i]).cast<float>();
  }
  for (std::size_t l = 0; l < boxes.leaf_boxes.size(); ++l) {
    std::uint8_t any = 0;
    for (const auto& corner : tree_.corners[l].vertex) {
      for (const std::int32_t v : corner) any |= moved[static_cast<std::size_t>(v)];
    }
    boxes.is_changed[l] = any;
    if (any != 0) measure_leaf(l, boxes);
  }
}

std::vector<CrossingSearch::Pair> CrossingSearch::intersecting_pairs(
    const Positions& mesh, const Boxes& boxes,
    const std::function<bool(std::uint32_t)>& is_exempt) const {
  std::vector<Pair> pairs;
  for (const LeafPair& pair : leaf_pairs_) {
    if ((boxes.is_changed[pair.first] | boxes.is_changed[pair.second]) == 0) continue;
    if (!boxes_overlap(boxes.leaf_boxes[pair.first], boxes.leaf_boxes[pair.second])) continue;
    std::uint64_t left =
        (pair.always_tested_mask | pair.tested_if_normals_differ_mask) &
        overlap_mask(boxes.triangle_boxes[pair.first], boxes.triangle_boxes[pair.second]);
    if ((left & pair.tested_if_normals_differ_mask) != 0) {
      left &= pair.always_tested_mask |
              ~similar_normal_mask(boxes.leaf_normals[pair.first], boxes.leaf_normals[pair.second],
                                   kSimilarNormalCosine);
    }
    for (; left != 0; left &= left - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(left));
      const std::uint32_t t = tree_.leaf(pair.first)[bit / LeafBoxes::kMaxTriangles];
      const std::uint32_t u = tree_.leaf(pair.second)[bit % LeafBoxes::kMaxTriangles];
      if (is_exempt(t) && is_exempt(u)) continue;
      if (!triangles_intersect(mesh, triangles_[t], triangles_[u])) continue;
      pairs.push_back({std::min(t, u), std::max(t, u)});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace crowdface
