// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/crossing_search.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

#include <hwy/highway.h>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {
namespace {

using Box = CrossingSearch::Box;

/// Triangles so many edges apart are of one sheet if they face alike: the least cosine.
constexpr int kSheetRings = 3;
constexpr double kAlike = 0.9;

constexpr float kEnd = std::numeric_limits<float>::infinity();
constexpr Box kNoBox{{kEnd, kEnd, kEnd}, {-kEnd, -kEnd, -kEnd}};

void add(const Box& other, Box& box) {
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] = std::min(box.low[c], other.low[c]);
    box.high[c] = std::max(box.high[c], other.high[c]);
  }
}

/// Without branches, which no processor foresees here.
bool meet(const Box& a, const Box& b) {
  unsigned apart = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    apart |= static_cast<unsigned>(a.low[c] > b.high[c]);
    apart |= static_cast<unsigned>(b.low[c] > a.high[c]);
  }
  return apart == 0;
}

Box common(const Box& a, const Box& b) {
  Box box;
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] = std::max(a.low[c], b.low[c]);
    box.high[c] = std::min(a.high[c], b.high[c]);
  }
  return box;
}

/// No smaller than in double precision: what is rounded keeps its order.
Box box_of(const Positions& mesh, const Triangle& triangle) {
  const auto& [a, b, d] = triangle;
  Box box;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto k = static_cast<Index>(c);
    box.low[c] = static_cast<float>(std::min({mesh(a, k), mesh(b, k), mesh(d, k)}));
    box.high[c] = static_cast<float>(std::max({mesh(a, k), mesh(b, k), mesh(d, k)}));
  }
  return box;
}

/// Which of a leaf's boxes meet another: bit i of the i-th.
std::uint32_t meeting(const CrossingSearch::LeafBoxes& leaf, const Box& box) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, CrossingSearch::kLeaf> d;
  std::uint32_t apart = 0;
  for (std::size_t i = 0; i < CrossingSearch::kLeaf; i += hn::Lanes(d)) {
    const auto beyond = [&](std::size_t c) {
      return hn::Or(hn::Gt(hn::LoadU(d, &leaf.low[c][i]), hn::Set(d, box.high[c])),
                    hn::Gt(hn::Set(d, box.low[c]), hn::LoadU(d, &leaf.high[c][i])));
    };
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Or(hn::Or(beyond(0), beyond(1)), beyond(2)), bits);
    apart |= static_cast<std::uint32_t>(bits[0]) << i;
  }
  return ~apart & 0xffU;
}

Box box_in(const CrossingSearch::LeafBoxes& leaf, std::size_t i) {
  return {{leaf.low[0][i], leaf.low[1][i], leaf.low[2][i]},
          {leaf.high[0][i], leaf.high[1][i], leaf.high[2][i]}};
}

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

  void search(std::uint32_t from) {
    from_ = from;
    std::vector<std::uint32_t> edge = {from}, next;
    seen_[from] = from;
    for (int ring = 0; ring < kSheetRings; ++ring, std::swap(edge, next)) {
      next.clear();
      for (const std::uint32_t t : edge) {
        for (const std::uint32_t v : triangles_[t]) {
          for (const std::uint32_t other : around_.of(v)) {
            if (seen_[other] == from) continue;
            seen_[other] = from;
            next.push_back(other);
          }
        }
      }
    }
  }
  bool have(std::uint32_t triangle) const { return seen_[triangle] == from_; }

 private:
  std::span<const Triangle> triangles_;
  Grouped<std::uint32_t> around_;    ///< #V
  std::vector<std::uint32_t> seen_;  ///< #triangles: from which
  std::uint32_t from_ = kNoIndex;
};

}  // namespace

CrossingSearch::CrossingSearch(std::vector<Triangle> triangles, const Positions& mesh, double reach)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
  if (triangles_.empty()) return;
  // Sheets that lie on each other come into different leaves.
  Positions places(static_cast<Index>(triangles_.size()), 3);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    const Eigen::Vector3d area = area_vector(mesh, triangles_[t]);
    const double length = length3(area);
    Eigen::Vector3d place = (row3(mesh, a) + row3(mesh, b) + row3(mesh, c)) / 3;
    if (length > 0) place += reach / length * area;
    places.row(static_cast<Index>(t)) = place.transpose();
  }
  std::iota(order_.begin(), order_.end(), 0U);
  add_leaves(order_, places);
  find_near(mesh, reach);
}

/// Halves them along their longest side until a leaf holds them.
void CrossingSearch::add_leaves(std::span<std::uint32_t> numbers, const Positions& places) {
  if (numbers.size() <= kLeaf) {
    begins_.push_back(begins_.back() + static_cast<std::uint32_t>(numbers.size()));
    return;
  }
  Eigen::RowVector3d low = places.row(numbers.front()), high = low;
  for (const std::uint32_t t : numbers) {
    low = low.cwiseMin(places.row(t));
    high = high.cwiseMax(places.row(t));
  }
  Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t half = (numbers.size() + 2 * kLeaf - 1) / (2 * kLeaf) * kLeaf;
  std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(half),
                   numbers.end(), [&](std::uint32_t a, std::uint32_t b) {
                     const double x = places(a, axis), y = places(b, axis);
                     return x != y ? x < y : a < b;
                   });
  // Which of equals come first is the library's choice.
  std::sort(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(half));
  std::sort(numbers.begin() + static_cast<std::ptrdiff_t>(half), numbers.end());
  add_leaves(numbers.first(half), places);
  add_leaves(numbers.subspan(half), places);
}

void CrossingSearch::find_near(const Positions& mesh, double reach) {
  const Boxes boxes = boxes_of(mesh);
  const std::size_t count = boxes.leaves.size();
  std::vector<Eigen::Vector3d> normals;
  for (const Triangle& triangle : triangles_) {
    const Eigen::Vector3d area = area_vector(mesh, triangle);
    const double length = length3(area);
    normals.push_back(length > 0 ? Eigen::Vector3d(area / length) : area);
  }
  std::vector<std::uint32_t> along(count);
  std::iota(along.begin(), along.end(), 0U);
  std::sort(along.begin(), along.end(), [&](std::uint32_t a, std::uint32_t b) {
    const float x = boxes.leaves[a].low[0], y = boxes.leaves[b].low[0];
    return x != y ? x < y : a < b;
  });
  const auto by = static_cast<float>(reach);
  Rings rings(triangles_, mesh.rows());
  for (std::size_t i = 0; i < count; ++i) {
    Box wide = boxes.leaves[along[i]];
    for (std::size_t c = 0; c < 3; ++c) {
      wide.low[c] -= by;
      wide.high[c] += by;
    }
    std::vector<Near> here;
    for (std::size_t j = i; j < count && boxes.leaves[along[j]].low[0] <= wide.high[0]; ++j) {
      if (meet(wide, boxes.leaves[along[j]])) here.push_back({along[i], along[j], 0});
    }
    const auto ones = leaf(along[i]);
    for (std::size_t k = 0; k < ones.size(); ++k) {
      rings.search(ones[k]);
      for (Near& near : here) {
        const auto others = leaf(near.other);
        for (std::size_t m = near.other == near.one ? k + 1 : 0; m < others.size(); ++m) {
          const std::uint32_t one = ones[k], other = others[m];
          if (rings.have(other) && (share_vertex(triangles_[one], triangles_[other]) ||
                                    dot3(normals[one], normals[other]) > kAlike)) {
            continue;
          }
          near.asked |= std::uint64_t{1} << (kLeaf * k + m);
        }
      }
    }
    std::copy_if(here.begin(), here.end(), std::back_inserter(near_),
                 [](const Near& near) { return near.asked != 0; });
  }
}

void CrossingSearch::measure(const Positions& mesh, std::size_t l, Boxes& boxes) const {
  Box all = kNoBox;
  CrossingSearch::LeafBoxes& here = boxes.triangles[l];
  const auto triangles = leaf(l);
  for (std::size_t i = 0; i < kLeaf; ++i) {
    const Box box = i < triangles.size() ? box_of(mesh, triangles_[triangles[i]]) : kNoBox;
    for (std::size_t c = 0; c < 3; ++c) {
      here.low[c][i] = box.low[c];
      here.high[c][i] = box.high[c];
    }
    add(box, all);
  }
  boxes.leaves[l] = all;
}

CrossingSearch::Boxes CrossingSearch::boxes_of(const Positions& mesh) const {
  const std::size_t leaves = begins_.size() - 1;
  Boxes boxes{std::vector<LeafBoxes>(leaves), std::vector<Box>(leaves),
              std::vector<std::uint8_t>(leaves, 1)};
  for (std::size_t l = 0; l < leaves; ++l) measure(mesh, l, boxes);
  return boxes;
}

void CrossingSearch::renew(const Positions& mesh, const std::vector<bool>& changed,
                           Boxes& boxes) const {
  for (std::size_t l = 0; l < boxes.leaves.size(); ++l) {
    const auto here = leaf(l);
    boxes.is_new[l] = std::any_of(here.begin(), here.end(), [&](std::uint32_t t) {
      const auto& [a, b, c] = triangles_[t];
      return changed[a] || changed[b] || changed[c];
    });
    if (boxes.is_new[l] != 0) measure(mesh, l, boxes);
  }
}

std::vector<CrossingSearch::Pair> CrossingSearch::crossing(const Positions& mesh,
                                                           const Boxes& boxes,
                                                           const std::vector<bool>& excused) const {
  std::vector<Pair> pairs;
  for (const Near& near : near_) {
    const Box &a = boxes.leaves[near.one], &b = boxes.leaves[near.other];
    if ((boxes.is_new[near.one] | boxes.is_new[near.other]) == 0 || !meet(a, b)) continue;
    const Box both = common(a, b);
    const LeafBoxes &one = boxes.triangles[near.one], &other = boxes.triangles[near.other];
    const std::uint64_t others = meeting(other, both);
    if (others == 0) continue;
    for (std::uint32_t ones = meeting(one, both); ones != 0; ones &= ones - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(ones));
      std::uint64_t left = near.asked >> (kLeaf * i) & others;
      if (left != 0) left &= meeting(other, box_in(one, i));
      for (; left != 0; left &= left - 1) {
        const auto j = static_cast<std::size_t>(std::countr_zero(left));
        const std::uint32_t t = leaf(near.one)[i], u = leaf(near.other)[j];
        if (excused[t] && excused[u]) continue;
        if (!triangles_intersect(mesh, triangles_[t], triangles_[u])) continue;
        pairs.push_back({std::min(t, u), std::max(t, u)});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace crowdface
