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
constexpr float kAlike = 0.98F;

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

CrossingSearch::CrossingSearch(std::vector<Triangle> triangles, const Positions& mesh, double reach,
                               double facing)
    : triangles_(std::move(triangles)) {
  for (const Triangle& t : triangles_) vertices_.insert(vertices_.end(), t.begin(), t.end());
  std::ranges::sort(vertices_);
  vertices_.erase(std::ranges::unique(vertices_).begin(), vertices_.end());
  std::vector<Triangle> numbered = triangles_;
  for (Triangle& triangle : numbered) {
    for (std::uint32_t& v : triangle) {
      v = static_cast<std::uint32_t>(std::ranges::lower_bound(vertices_, v) - vertices_.begin());
    }
  }
  Positions points(static_cast<Index>(vertices_.size()), 3);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    points.row(static_cast<Index>(i)) = mesh.row(vertices_[i]);
  }
  tree_ = TriangleTree(numbered, points, reach);
  find_near(numbered, points, reach, facing);
  leave_out_sheets(numbered);
}

/// Which triangles are so near to each other that they are to be asked about, sheets not left out yet.
void CrossingSearch::find_near(const std::vector<Triangle>& numbered, const Positions& points,
                               double reach, double facing) {
  const SingleRows single = points.cast<float>();
  std::vector<LeafBoxes> close, far;
  std::vector<LeafNormals> normals;
  for (const LeafCorners& corners : tree_.corners) {
    close.emplace_back(corners, single, reach / 2);
    far.emplace_back(corners, single, facing / 2);
    normals.emplace_back(corners, single);
  }
  for (const auto& [one, other] :
       TriangleScene(numbered, tree_, points, facing / 2).near_leaves()) {
    std::uint64_t near = overlapping(far[one], far[other]);
    if (near != 0) near &= ~facing_alike(normals[one], normals[other], 0);
    near |= overlapping(close[one], close[other]);
    if (one == other) near &= kOnce;
    if (near != 0) near_.push_back({one, other, near, 0});
  }
  std::ranges::sort(near_, {}, [](const Near& near) { return std::pair(near.one, near.other); });
}

/// Of triangles few edges apart only those are asked about which do not face alike.
void CrossingSearch::leave_out_sheets(const std::vector<Triangle>& numbered) {
  std::vector<std::uint32_t> place(numbered.size(), kNoIndex);  // in the leaves' order
  for (std::uint32_t i = 0; i < tree_.order.size(); ++i) place[tree_.order[i]] = i;
  Rings rings(numbered, static_cast<Index>(vertices_.size()));
  std::vector<std::uint32_t> near_of(tree_.leaf_count(), kNoIndex);  // of the leaf at hand
  for (auto begin = near_.begin(), end = begin; begin != near_.end(); begin = end) {
    for (; end != near_.end() && end->one == begin->one; ++end) {
      near_of[end->other] = static_cast<std::uint32_t>(end - near_.begin());
    }
    const auto ones = tree_.leaf(begin->one);
    for (std::size_t k = 0; k < ones.size(); ++k) {
      for (const std::uint32_t other : rings.around(ones[k])) {
        if (place[other] == kNoIndex) continue;
        const std::uint32_t number = near_of[place[other] / LeafBoxes::kCount];
        if (number == kNoIndex) continue;
        Near& near = near_[number];
        const std::uint64_t bit = std::uint64_t{1}
                                  << (LeafBoxes::kCount * k + place[other] % LeafBoxes::kCount);
        if (!share_vertex(numbered[ones[k]], numbered[other])) near.folded |= near.always & bit;
        near.always &= ~bit;
      }
    }
    for (auto pair = begin; pair != end; ++pair) near_of[pair->other] = kNoIndex;
  }
  std::erase_if(near_, [](const Near& near) { return (near.always | near.folded) == 0; });
}

void CrossingSearch::measure(std::size_t l, Boxes& boxes) const {
  boxes.triangles[l] = LeafBoxes(tree_.corners[l], boxes.points, 0);
  boxes.leaves[l] = boxes.triangles[l].whole();
  boxes.normals[l] = LeafNormals(tree_.corners[l], boxes.points);
}

CrossingSearch::Boxes CrossingSearch::boxes_of(const Positions& mesh) const {
  const std::size_t leaves = tree_.leaf_count();
  Boxes boxes{SingleRows(static_cast<Index>(vertices_.size()), 3), std::vector<LeafBoxes>(leaves),
              std::vector<LeafNormals>(leaves), std::vector<Box>(leaves),
              std::vector<std::uint8_t>(leaves, 1)};
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    boxes.points.row(static_cast<Index>(i)) = mesh.row(vertices_[i]).cast<float>();
  }
  for (std::size_t l = 0; l < leaves; ++l) measure(l, boxes);
  return boxes;
}

void CrossingSearch::renew(const Positions& mesh, const std::vector<bool>& changed,
                           Boxes& boxes) const {
  std::vector<std::uint8_t> moved(vertices_.size(), 0);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (!changed[vertices_[i]]) continue;
    moved[i] = 1;
    boxes.points.row(static_cast<Index>(i)) = mesh.row(vertices_[i]).cast<float>();
  }
  for (std::size_t l = 0; l < boxes.leaves.size(); ++l) {
    std::uint8_t any = 0;
    for (const auto& corner : tree_.corners[l].vertex) {
      for (const std::int32_t v : corner) any |= moved[static_cast<std::size_t>(v)];
    }
    boxes.is_new[l] = any;
    if (any != 0) measure(l, boxes);
  }
}

std::vector<CrossingSearch::Pair> CrossingSearch::crossing(
    const Positions& mesh, const Boxes& boxes,
    const std::function<bool(std::uint32_t)>& excused) const {
  std::vector<Pair> pairs;
  for (const Near& near : near_) {
    if ((boxes.is_new[near.one] | boxes.is_new[near.other]) == 0) continue;
    if (!overlap(boxes.leaves[near.one], boxes.leaves[near.other])) continue;
    std::uint64_t left = (near.always | near.folded) &
                         overlapping(boxes.triangles[near.one], boxes.triangles[near.other]);
    if ((left & near.folded) != 0) {
      left &=
          near.always | ~facing_alike(boxes.normals[near.one], boxes.normals[near.other], kAlike);
    }
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
