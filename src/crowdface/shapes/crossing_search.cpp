// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/crossing_search.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/validity/triangle_scene.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {
namespace {

/// Triangles so many edges apart are of one sheet if they face alike: the least cosine.
constexpr int kSheetRings = 3;
constexpr double kAlike = 0.9;

/// Of a leaf with itself: each pair once.
constexpr std::uint64_t kOnce = [] {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < LeafBoxes::kCount; ++i) {
    for (std::size_t j = i + 1; j < LeafBoxes::kCount; ++j) {
      bits |= std::uint64_t{1} << (LeafBoxes::kCount * i + j);
    }
  }
  return bits;
}();

/// Which triangles are how many edges from one.
class Rings {
 public:
  Rings(std::span<const Triangle> triangles, Index vertex_count)
      : triangles_(triangles),
        around_(grouped<std::uint32_t>(static_cast<std::size_t>(vertex_count),
                                       [&](const auto& put) {
                                         for (std::uint32_t t = 0; t < triangles.size(); ++t) {
                                           for (const std::uint32_t v : triangles[t]) put(v, t);
                                         }
                                       })),
        seen_(triangles.size(), kNoIndex) {}

  /// Those within kSheetRings, the one itself included.
  std::span<const std::uint32_t> around(std::uint32_t from) {
    reached_ = {from};
    seen_[from] = from;
    std::size_t begin = 0;
    for (int ring = 0; ring < kSheetRings; ++ring) {
      const std::size_t end = reached_.size();
      for (; begin < end; ++begin) {
        for (const std::uint32_t v : triangles_[reached_[begin]]) {
          for (const std::uint32_t other : around_.of(v)) {
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
  std::span<const Triangle> triangles_;
  Grouped<std::uint32_t> around_;    ///< #V
  std::vector<std::uint32_t> seen_;  ///< #triangles: from which
  std::vector<std::uint32_t> reached_;
};

}  // namespace

CrossingSearch::CrossingSearch(std::vector<Triangle> triangles, const Positions& mesh, double reach)
    : triangles_(std::move(triangles)), tree_(triangles_, mesh, reach) {
  find_near(mesh, reach);
}

void CrossingSearch::find_near(const Positions& mesh, double reach) {
  std::vector<Eigen::Vector3d> normals;
  for (const Triangle& triangle : triangles_) normals.push_back(unit3(area_vector(mesh, triangle)));
  auto leaves = TriangleScene(triangles_, tree_, mesh, reach / 2).near_leaves();
  std::ranges::sort(leaves, {}, [](const auto& pair) { return std::pair(pair.one, pair.other); });
  std::vector<std::uint32_t> place(triangles_.size(), kNoIndex);  // in the leaves' order
  for (std::uint32_t i = 0; i < tree_.order.size(); ++i) place[tree_.order[i]] = i;
  Rings rings(triangles_, mesh.rows());
  std::vector<std::uint32_t> near_of(tree_.leaf_count(), kNoIndex);  // of the leaf at hand
  for (auto begin = leaves.begin(), end = begin; begin != leaves.end(); begin = end) {
    for (; end != leaves.end() && end->one == begin->one; ++end) {
      near_of[end->other] = static_cast<std::uint32_t>(near_.size());
      near_.push_back({end->one, end->other, end->one == end->other ? kOnce : ~std::uint64_t{0}});
    }
    const auto ones = tree_.leaf(begin->one);
    for (std::size_t k = 0; k < ones.size(); ++k) {
      for (const std::uint32_t other : rings.around(ones[k])) {
        if (place[other] == kNoIndex) continue;
        const std::uint32_t near = near_of[place[other] / LeafBoxes::kCount];
        if (near == kNoIndex || (!share_vertex(triangles_[ones[k]], triangles_[other]) &&
                                 dot3(normals[ones[k]], normals[other]) <= kAlike)) {
          continue;
        }
        const std::size_t bit = LeafBoxes::kCount * k + place[other] % LeafBoxes::kCount;
        near_[near].asked &= ~(std::uint64_t{1} << bit);
      }
    }
    for (auto pair = begin; pair != end; ++pair) near_of[pair->other] = kNoIndex;
  }
  std::erase_if(near_, [](const Near& near) { return near.asked == 0; });
}

void CrossingSearch::measure(const Positions& mesh, std::size_t l, Boxes& boxes) const {
  boxes.triangles[l] = LeafBoxes(tree_.leaf(l), triangles_, mesh, 0);
  boxes.leaves[l] = boxes.triangles[l].whole();
}

CrossingSearch::Boxes CrossingSearch::boxes_of(const Positions& mesh) const {
  const std::size_t leaves = tree_.leaf_count();
  Boxes boxes{std::vector<LeafBoxes>(leaves), std::vector<Box>(leaves),
              std::vector<std::uint8_t>(leaves, 1)};
  for (std::size_t l = 0; l < leaves; ++l) measure(mesh, l, boxes);
  return boxes;
}

void CrossingSearch::renew(const Positions& mesh, const std::vector<bool>& changed,
                           Boxes& boxes) const {
  for (std::size_t l = 0; l < boxes.leaves.size(); ++l) {
    const auto here = tree_.leaf(l);
    boxes.is_new[l] = std::any_of(here.begin(), here.end(), [&](std::uint32_t t) {
      const auto& [a, b, c] = triangles_[t];
      return changed[a] || changed[b] || changed[c];
    });
    if (boxes.is_new[l] != 0) measure(mesh, l, boxes);
  }
}

std::vector<CrossingSearch::Pair> CrossingSearch::crossing(
    const Positions& mesh, const Boxes& boxes,
    const std::function<bool(std::uint32_t)>& excused) const {
  std::vector<Pair> pairs;
  for (const Near& near : near_) {
    if ((boxes.is_new[near.one] | boxes.is_new[near.other]) == 0) continue;
    if (!overlap(boxes.leaves[near.one], boxes.leaves[near.other])) continue;
    std::uint64_t left =
        near.asked & overlapping(boxes.triangles[near.one], boxes.triangles[near.other]);
    for (; left != 0; left &= left - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(left));
      const std::uint32_t t = tree_.leaf(near.one)[bit / LeafBoxes::kCount];
      const std::uint32_t u = tree_.leaf(near.other)[bit % LeafBoxes::kCount];
      if (excused(t) && excused(u)) continue;
      if (!triangles_intersect(mesh, triangles_[t], triangles_[u])) continue;
      pairs.push_back({std::min(t, u), std::max(t, u)});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace crowdface
