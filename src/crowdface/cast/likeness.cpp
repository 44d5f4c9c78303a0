// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "crowdface/cast/point_blocks.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::size_t kBlock = 64;

/// Faces that can be asked for those that look most like one of them, and taken out one by one: a k-d
/// tree (Friedman, Bentley & Finkel 1977) over the leading coordinates. Answers are exact: those of
/// FaceSpace::distance over all faces, of equally near ones the first.
class LikenessTree {
 public:
  /// \param points  at least one; must outlive this object.
  explicit LikenessTree(const std::vector<FaceSpace::Point>& points)
      : points_(points),
        faces_(points.size()),
        place_(points.size()),
        gone_(points.size(), false),
        leaf_((points.size() + kLeaf - 1) / kLeaf, -1) {
    std::iota(faces_.begin(), faces_.end(), 0U);
    build(0, static_cast<std::uint32_t>(points.size()), -1);
    for (std::uint32_t p = 0; p < faces_.size(); ++p) place_[faces_[p]] = p;
    variants_.push_back(variant(&FaceSpace::Point::as_built));
    if (std::any_of(points.begin(), points.end(),
                    [](const FaceSpace::Point& point) { return point.as_built != point.unit; })) {
      variants_.push_back(variant(&FaceSpace::Point::unit));
    }
  }

  /// All faces, those that look alike mostly side by side: so they are best asked for.
  std::span<const std::uint32_t> faces() const { return faces_; }
  bool has(std::size_t face) const { return !gone_[place_[face]]; }
  /// Takes a face out.
  void remove(std::size_t face) {
    gone_[place_[face]] = true;
    for (std::int32_t at = leaf_[place_[face] / kLeaf]; at >= 0;) {
      Node& node = nodes_[static_cast<std::size_t>(at)];
      --node.left;
      at = node.parent;
    }
  }

  /// The nearest others that are left, nearest first.
  std::vector<Neighbour> nearest(std::size_t face, std::size_t count) const {
    Search found{face, count};
    if (count == 0) return {};
    found.near.reserve(count + 1);
    const FaceSpace::Point& point = points_[face];
    for (std::size_t v = 0; v < variants_.size(); ++v) {
      found.queries.push_back(variants_[v].points.padded(v == 0 ? point.as_built : point.unit));
    }
    search(0, found);
    return std::move(found.near);
  }

 private:
  static constexpr std::size_t kLeaf = 2 * PointBlocks::kLanes;

  /// The points of all faces, as built or with factors of 1, leaf by leaf.
  struct Variant {
    PointBlocks points;
    std::vector<LeadingBox> boxes;  ///< #nodes
  };
  struct Node {
    std::uint32_t begin = 0, end = 0, left = 0;  ///< places of its faces; how many are left
    std::int32_t parent = -1;
    std::array<std::int32_t, 2> children = {-1, -1};  ///< −1: a leaf
  };
  /// The nearest faces that a search has met.
  struct Search {
    std::size_t face = 0, count = 0;
    std::vector<std::vector<float>> queries = {};  ///< the face's point of each variant
    std::vector<Neighbour> near = {};
    float bound = HUGE_VALF;  ///< what has a greater squared distance need not be met

    void meet(std::size_t other, double mm) {
      const auto nearer = [](const Neighbour& a, const Neighbour& b) {
        return a.mm != b.mm ? a.mm < b.mm : a.face < b.face;
      };
      const Neighbour found{other, mm};
      if (near.size() == count && !nearer(found, near.back())) return;
      near.insert(std::upper_bound(near.begin(), near.end(), found, nearer), found);
      if (near.size() > count) near.pop_back();
      if (near.size() == count) {
        bound = static_cast<float>(near.back().mm * near.back().mm * (1 + PointBlocks::kRounding));
      }
    }
  };

  std::int32_t build(std::uint32_t begin, std::uint32_t end, std::int32_t parent) {
    const auto at = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({begin, end, end - begin, parent});
    if (end - begin <= kLeaf) {
      leaf_[begin / kLeaf] = at;
      return at;
    }
    const auto value = [&](std::uint32_t face, Index d) { return points_[face].as_built[d]; };
    const auto first = faces_.begin() + begin, last = faces_.begin() + end;
    Index widest = 0;
    float greatest = -1;
    const Index dimensions =
        std::min(points_[0].as_built.size(), static_cast<Index>(LeadingBox::kDimensions));
    for (Index d = 0; d < dimensions; ++d) {
      const auto [low, high] = std::minmax_element(
          first, last, [&](auto a, auto b) { return value(a, d) < value(b, d); });
      const float width = value(*high, d) - value(*low, d);
      if (width > greatest) widest = d;
      greatest = std::max(greatest, width);
    }
    // Leaves begin with whole blocks.
    const auto half =
        static_cast<std::uint32_t>(std::max<std::size_t>(1, (end - begin) / 2 / kLeaf) * kLeaf);
    std::nth_element(first, first + half, last, [&](std::uint32_t a, std::uint32_t b) {
      const float left = value(a, widest), right = value(b, widest);
      return left != right ? left < right : a < b;
    });
    const std::int32_t left = build(begin, begin + half, at);
    const std::int32_t right = build(begin + half, end, at);
    nodes_[static_cast<std::size_t>(at)].children = {left, right};
    return at;
  }

  Variant variant(Eigen::VectorXf FaceSpace::Point::*of) const {
    Variant variant{PointBlocks((points_[0].*of).size()), std::vector<LeadingBox>(nodes_.size())};
    for (const std::uint32_t face : faces_) {
      variant.points.add(static_cast<Index>(face), variant.points.padded(points_[face].*of).data());
    }
    for (std::size_t n = nodes_.size(); n-- > 0;) {  // children stand behind their parents
      const Node& node = nodes_[n];
      LeadingBox& box = variant.boxes[n];
      box.low.fill(HUGE_VALF);
      box.high.fill(-HUGE_VALF);
      const auto widen = [&](std::size_t d, float low, float high) {
        box.low[d] = std::min(box.low[d], low);
        box.high[d] = std::max(box.high[d], high);
      };
      for (std::size_t d = 0; d < LeadingBox::kDimensions; ++d) {
        if (node.children[0] < 0) {
          for (std::uint32_t p = node.begin; p < node.end; ++p) {
            const float value = variant.points.value(p, static_cast<Index>(d));
            widen(d, value, value);
          }
          continue;
        }
        for (const std::int32_t child : node.children) {
          const LeadingBox& part = variant.boxes[static_cast<std::size_t>(child)];
          widen(d, part.low[d], part.high[d]);
        }
      }
    }
    return variant;
  }

  float squared_distance(std::int32_t node, const Search& search) const {
    float least = HUGE_VALF;
    for (std::size_t v = 0; v < variants_.size(); ++v) {
      const LeadingBox& box = variants_[v].boxes[static_cast<std::size_t>(node)];
      least = std::min(least, box.squared_distance(search.queries[v]));
    }
    return least;
  }

  void search_leaf(const Node& leaf, Search& search) const {
    constexpr auto kLanes = static_cast<std::uint32_t>(PointBlocks::kLanes);
    for (std::uint32_t first = leaf.begin; first < leaf.end; first += kLanes) {
      PointBlocks::Lanes least;
      least.fill(HUGE_VALF);
      for (std::size_t v = 0; v < variants_.size(); ++v) {
        const PointBlocks::Lanes squared =
            variants_[v].points.squared_distances(search.queries[v], first / kLanes, search.bound);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          least[lane] = std::min(least[lane], squared[lane]);
        }
      }
      for (std::uint32_t p = first; p < std::min(first + kLanes, leaf.end); ++p) {
        const std::size_t other = faces_[p];
        if (least[p - first] > search.bound || gone_[p] || other == search.face) continue;
        search.meet(other, FaceSpace::distance(points_[search.face], points_[other]));
      }
    }
  }

  void search(std::int32_t at, Search& search) const {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    if (node.children[0] < 0) return search_leaf(node, search);
    std::array<std::pair<float, std::int32_t>, 2> nearer;
    for (std::size_t c = 0; c < 2; ++c) {
      nearer[c] = {squared_distance(node.children[c], search), node.children[c]};
    }
    if (nearer[1].first < nearer[0].first) std::swap(nearer[0], nearer[1]);
    for (const auto& [squared, child] : nearer) {
      if (squared > search.bound) return;
      if (nodes_[static_cast<std::size_t>(child)].left > 0) this->search(child, search);
    }
  }

  const std::vector<FaceSpace::Point>& points_;
  std::vector<std::uint32_t> faces_;  ///< by their places, leaf by leaf
  std::vector<std::uint32_t> place_;  ///< of each face
  std::vector<bool> gone_;            ///< by their places
  std::vector<std::int32_t> leaf_;    ///< of each group of kLeaf places
  std::vector<Node> nodes_;
  std::vector<Variant> variants_;  ///< one, if all faces are as with factors of 1
};

/// The face farthest from the first; of equally far ones the first.
std::size_t farthest_from_first(const std::vector<FaceSpace::Point>& points) {
  std::vector<double> mm(points.size());
  parallel_for_each(points.size(), 16 * kBlock, [&](std::size_t other) {
    mm[other] = FaceSpace::distance(points[0], points[other]);
  });
  return static_cast<std::size_t>(std::max_element(mm.begin(), mm.end()) - mm.begin());
}

/// \param near  of each face: whoever is left of them is nearer than all who are not among them.
std::vector<std::size_t> walk(const std::vector<FaceSpace::Point>& points,
                              const std::vector<std::vector<Neighbour>>& near, LikenessTree& tree) {
  std::vector<std::size_t> order = {farthest_from_first(points)};
  while (true) {
    throw_if_interrupted();
    const std::size_t at = order.back();
    tree.remove(at);
    if (order.size() == points.size()) return order;
    const auto next = std::find_if(near[at].begin(), near[at].end(),
                                   [&](const Neighbour& other) { return tree.has(other.face); });
    order.push_back(next != near[at].end() ? next->face : tree.nearest(at, 1).front().face);
  }
}

}  // namespace

Likeness find_likeness(const std::vector<FaceSpace::Point>& points, std::size_t neighbours) {
  Likeness likeness;
  if (points.empty()) return likeness;
  LikenessTree tree(points);
  likeness.near.resize(points.size());
  parallel_for_each(points.size(), kBlock, [&](std::size_t place) {
    const std::size_t face = tree.faces()[place];
    likeness.near[face] = tree.nearest(face, neighbours);
  });
  likeness.order = walk(points, likeness.near, tree);
  return likeness;
}

}  // namespace crowdface
