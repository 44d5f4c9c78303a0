// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/likeness_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crowdface {
namespace {

constexpr std::uint32_t kLeaf = 16;
/// A box is left out if it is farther than what was found by more than sums of floats can err.
constexpr double kRounding = 1e-4;

}  // namespace

/// The nearest faces that a search has met.
struct LikenessTree::Search {
  std::size_t face = 0, count = 0;
  std::vector<Neighbour> near = {};

  bool rules_out(float squared) const {
    return near.size() == count &&
           static_cast<double>(squared) * (1 - kRounding) > near.back().mm * near.back().mm;
  }

  void meet(std::size_t other, double mm) {
    const auto nearer = [](const Neighbour& a, const Neighbour& b) {
      return a.mm != b.mm ? a.mm < b.mm : a.face < b.face;
    };
    const Neighbour found{other, mm};
    if (near.size() == count && !nearer(found, near.back())) return;
    near.insert(std::upper_bound(near.begin(), near.end(), found, nearer), found);
    if (near.size() > count) near.pop_back();
  }
};

LikenessTree::LikenessTree(const std::vector<FaceSpace::Point>& points)
    : points_(points),
      box_dimensions_(points.empty() ? 0 : std::min(points[0].as_built.size(), kBoxDimensions)),
      faces_(points.size()),
      leaf_(points.size(), -1) {
  std::iota(faces_.begin(), faces_.end(), 0U);
  if (!points.empty()) build(0, static_cast<std::uint32_t>(points.size()), -1);
}

LikenessTree::Box LikenessTree::box_of(std::uint32_t begin, std::uint32_t end,
                                       Eigen::VectorXf FaceSpace::Point::*variant) const {
  Box box;
  for (Index d = 0; d < box_dimensions_; ++d) {
    const auto c = static_cast<std::size_t>(d);
    box.low[c] = box.high[c] = (points_[faces_[begin]].*variant)[d];
    for (std::uint32_t f = begin + 1; f < end; ++f) {
      const float value = (points_[faces_[f]].*variant)[d];
      box.low[c] = std::min(box.low[c], value);
      box.high[c] = std::max(box.high[c], value);
    }
  }
  return box;
}

std::int32_t LikenessTree::build(std::uint32_t begin, std::uint32_t end, std::int32_t parent) {
  const auto at = static_cast<std::int32_t>(nodes_.size());
  Node node{box_of(begin, end, &FaceSpace::Point::as_built),
            box_of(begin, end, &FaceSpace::Point::unit), begin, end - begin, parent};
  nodes_.push_back(node);
  if (end - begin <= kLeaf) {
    for (std::uint32_t f = begin; f < end; ++f) leaf_[faces_[f]] = at;
    return at;
  }
  Index widest = 0;
  const auto width = [&](Index d) {
    const auto c = static_cast<std::size_t>(d);
    return node.as_built.high[c] - node.as_built.low[c];
  };
  for (Index d = 1; d < box_dimensions_; ++d) {
    if (width(d) > width(widest)) widest = d;
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(faces_.begin() + begin, faces_.begin() + middle, faces_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const float left = points_[a].as_built[widest];
                     const float right = points_[b].as_built[widest];
                     return left != right ? left < right : a < b;
                   });
  const std::int32_t left = build(begin, middle, at);
  const std::int32_t right = build(middle, end, at);
  nodes_[static_cast<std::size_t>(at)].children = {left, right};
  return at;
}

void LikenessTree::remove(std::size_t face) {
  Node& leaf = nodes_[static_cast<std::size_t>(leaf_[face])];
  const auto first = faces_.begin() + leaf.first, last = first + leaf.left;
  std::iter_swap(std::find(first, last, static_cast<std::uint32_t>(face)), last - 1);
  for (std::int32_t at = leaf_[face]; at >= 0; at = nodes_[static_cast<std::size_t>(at)].parent) {
    --nodes_[static_cast<std::size_t>(at)].left;
  }
}

float LikenessTree::squared_distance(const Box& box, const Eigen::VectorXf& point) const {
  float sum = 0;
  for (Index d = 0; d < box_dimensions_; ++d) {
    const auto c = static_cast<std::size_t>(d);
    const float beyond = std::max({box.low[c] - point[d], point[d] - box.high[c], 0.F});
    sum += beyond * beyond;
  }
  return sum;
}

void LikenessTree::search(std::int32_t at, Search& search) const {
  const Node& node = nodes_[static_cast<std::size_t>(at)];
  const FaceSpace::Point& point = points_[search.face];
  if (node.children[0] < 0) {
    for (std::uint32_t f = node.first; f < node.first + node.left; ++f) {
      const std::size_t other = faces_[f];
      if (other != search.face) search.meet(other, FaceSpace::distance(point, points_[other]));
    }
    return;
  }
  std::array<std::pair<float, std::int32_t>, 2> nearer;
  for (std::size_t c = 0; c < 2; ++c) {
    const Node& child = nodes_[static_cast<std::size_t>(node.children[c])];
    nearer[c] = {std::min(squared_distance(child.as_built, point.as_built),
                          squared_distance(child.unit, point.unit)),
                 node.children[c]};
  }
  if (nearer[1].first < nearer[0].first) std::swap(nearer[0], nearer[1]);
  for (const auto& [squared, child] : nearer) {
    if (nodes_[static_cast<std::size_t>(child)].left == 0) continue;
    if (search.rules_out(squared)) return;
    this->search(child, search);
  }
}

std::vector<Neighbour> LikenessTree::nearest(std::size_t face, std::size_t count) const {
  Search found{face, count};
  if (count > 0) search(0, found);
  return std::move(found.near);
}

}  // namespace crowdface
