// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/triangle_scene.h"

#include <algorithm>
#include <array>
#include <bit>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kLeafSize = TriangleTree::kLeafSize;

/// Returns whether a ray hits a triangle. Source: Möller & Trumbore 1997, "Fast, minimum storage
/// ray/triangle intersection".
bool ray_hits_triangle(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                       const Positions& positions, const Triangle& triangle) {
  const Eigen::Vector3d a = row3(positions, triangle[0]);
  const Eigen::Vector3d ab = row3(positions, triangle[1]) - a;
  const Eigen::Vector3d ac = row3(positions, triangle[2]) - a;
  const Eigen::Vector3d p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return false;
  const Eigen::Vector3d from_a = origin - a;
  const double u = from_a.dot(p) / determinant;
  if (u < 0 || u > 1) return false;
  const Eigen::Vector3d q = from_a.cross(ab);
  const double v = direction.dot(q) / determinant;
  return v >= 0 && u + v <= 1 && ac.dot(q) / determinant > 0;
}

}  // namespace

TriangleScene::TriangleScene(const std::vector<Triangle>& triangles, const TriangleTree& tree,
                             const Positions& positions, double margin)
    : triangles_(triangles),
      tree_(tree),
      positions_(positions),
      leaves_(tree.leaf_count()),
      boxes_(tree.nodes.size()) {
  constexpr std::size_t kLeavesPerTask = 512;
  const FloatPositions points = positions.cast<float>();
  parallel_for_each(leaves_.size(), kLeavesPerTask, [&](std::size_t l) {
    leaves_[l] = LeafBoxes(tree.corners[l], points, margin);
  });
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    const TriangleTree::Node& node = tree.nodes[n];
    if (node.is_leaf()) {
      boxes_[n] = leaves_[TriangleTree::leaf_number(node)].bounding_box();
      continue;
    }
    const Box &left = boxes_[n + 1], &right = boxes_[node.second_child];
    for (std::size_t c = 0; c < 3; ++c) {
      boxes_[n].low[c] = std::min(left.low[c], right.low[c]);
      boxes_[n].high[c] = std::max(left.high[c], right.high[c]);
    }
  }
}

/// Divides a pair of nodes into smaller pairs, and adds to `into` the smaller pairs whose boxes
/// overlap. If the nodes differ, pairs each child of the larger node with the smaller node. If the
/// pair consists of one node twice, pairs the children of this node with themselves and with each
/// other.
///
/// \pre At least one node of the pair is not a leaf.
void TriangleScene::split(const NodePair& pair, std::vector<NodePair>& into) const {
  const TriangleTree::Node &a = tree_.nodes[pair.a], &b = tree_.nodes[pair.b];
  const auto add = [&](std::uint32_t first, std::uint32_t second) {
    if (boxes_overlap(boxes_[first], boxes_[second])) into.push_back({first, second});
  };
  if (pair.a == pair.b) {
    add(pair.a + 1, pair.a + 1);
    add(a.second_child, a.second_child);
    add(pair.a + 1, a.second_child);
  } else if (a.end - a.begin >= b.end - b.begin) {
    add(pair.a + 1, pair.b);
    add(a.second_child, pair.b);
  } else {
    add(pair.a, pair.b + 1);
    add(pair.a, b.second_child);
  }
}

template <class Keep>
void TriangleScene::compare_leaves(std::uint32_t one, std::uint32_t other, const Keep& keep,
                                   std::vector<TrianglePair>& found) const {
  // If a leaf is compared with itself, use only the bits 8 i + j with j > i, so that each pair of
  // triangles occurs once.
  constexpr std::uint64_t kPairsWithinLeaf = 0x0080c0e0f0f8fcfe;
  const auto ones = tree_.leaf(one), others = tree_.leaf(other);
  std::uint64_t left = overlap_mask(leaves_[one], leaves_[other]);
  if (one == other) left &= kPairsWithinLeaf;
  if (left != 0) left &= ~shared_vertex_mask(tree_.corners[one], tree_.corners[other]);
  for (; left != 0; left &= left - 1) {
    const auto bit = static_cast<std::size_t>(std::countr_zero(left));
    const std::uint32_t a = ones[bit / kLeafSize], b = others[bit % kLeafSize];
    const TrianglePair pair(std::min(a, b), std::max(a, b));
    if (keep(pair)) found.push_back(pair);
  }
}

std::vector<TriangleScene::NodePair> TriangleScene::initial_node_pairs() const {
  constexpr std::size_t kTasks = 64;
  std::vector<NodePair> pairs;
  if (!tree_.nodes.empty()) pairs.push_back({0, 0});
  for (bool is_split = true; is_split && pairs.size() < kTasks;) {
    is_split = false;
    std::vector<NodePair> finer;
    for (const NodePair& pair : pairs) {
      if (are_leaves(pair)) {
        finer.push_back(pair);
      } else {
        split(pair, finer);
        is_split = true;
      }
    }
    pairs = std::move(finer);
  }
  return pairs;
}

template <class Use>
void TriangleScene::visit_leaves(const NodePair& from, const Use& use) const {
  std::vector<NodePair> waiting = {from};
  while (!waiting.empty()) {
    const NodePair pair = waiting.back();
    waiting.pop_back();
    if (are_leaves(pair)) {
      use(TriangleTree::leaf_number(tree_.nodes[pair.a]),
          TriangleTree::leaf_number(tree_.nodes[pair.b]));
    } else {
      split(pair, waiting);
    }
  }
}

template <class Keep>
std::vector<TrianglePair> TriangleScene::filtered_pairs(const Keep& keep) const {
  const std::vector<NodePair> tasks = initial_node_pairs();
  std::vector<std::vector<TrianglePair>> found(tasks.size());
  parallel_for_each(tasks.size(), [&](std::size_t t) {
    visit_leaves(tasks[t], [&](std::uint32_t one, std::uint32_t other) {
      compare_leaves(one, other, keep, found[t]);
    });
  });
  std::vector<TrianglePair> pairs;
  for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<TrianglePair> TriangleScene::near_pairs() const {
  return filtered_pairs([](const TrianglePair& /*pair*/) { return true; });
}

std::vector<TrianglePair> TriangleScene::intersecting_pairs() const {
  return filtered_pairs([&](const TrianglePair& pair) {
    return triangles_intersect(positions_, triangles_[pair.first], triangles_[pair.second]);
  });
}

std::vector<std::uint32_t> TriangleScene::leaves_near(std::uint32_t leaf) const {
  const Box here = leaves_[leaf].bounding_box();
  std::vector<std::uint32_t> near, waiting = {0};
  while (!waiting.empty()) {
    const std::uint32_t n = waiting.back();
    waiting.pop_back();
    const TriangleTree::Node& node = tree_.nodes[n];
    if (node.end <= leaf * kLeafSize || !boxes_overlap(boxes_[n], here)) continue;
    if (node.is_leaf()) {
      near.push_back(TriangleTree::leaf_number(node));
    } else {
      waiting.push_back(node.second_child);
      waiting.push_back(n + 1);
    }
  }
  return near;
}

std::uint32_t TriangleScene::find_any_hit(const Eigen::Vector3d& origin,
                                          const Eigen::Vector3d& direction, std::uint32_t start,
                                          std::uint32_t guess) const {
  const auto is_met = [&](std::uint32_t place) {
    const std::uint32_t triangle = tree_.order[place];
    return triangle != start &&
           ray_hits_triangle(origin, direction, positions_, triangles_[triangle]);
  };
  if (guess != kNoIndex && is_met(guess)) return guess;
  if (tree_.nodes.empty()) return kNoIndex;
  const BoxRay box_ray(origin, direction);
  // Size of the stack; sufficient for 2³² triangles, because each level of the tree halves the
  // number of triangles in a node.
  constexpr std::size_t kMaxStackDepth = 40;
  std::array<std::uint32_t, kMaxStackDepth> waiting;
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::uint32_t n = waiting[--count];
    if (!ray_hits_box(box_ray, boxes_[n])) continue;
    const TriangleTree::Node& node = tree_.nodes[n];
    if (!node.is_leaf()) {
      // First visit the child that contains the triangle `guess`, which blocked the previous ray.
      // The triangles near `guess` often block this ray too.
      const bool right_first = guess != kNoIndex && guess >= tree_.nodes[node.second_child].begin;
      waiting[count++] = right_first ? n + 1 : node.second_child;
      waiting[count++] = right_first ? node.second_child : n + 1;
      continue;
    }
    unsigned left = hit_mask(box_ray, leaves_[TriangleTree::leaf_number(node)]) &
                    ((1U << (node.end - node.begin)) - 1);
    for (; left != 0; left &= left - 1) {
      const std::uint32_t place = node.begin + static_cast<std::uint32_t>(std::countr_zero(left));
      if (is_met(place)) return place;
    }
  }
  return kNoIndex;
}

}  // namespace crowdface
