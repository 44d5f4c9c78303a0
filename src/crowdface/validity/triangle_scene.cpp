// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/triangle_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kLeaf = TriangleTree::kLeaf;

/// Möller & Trumbore 1997, "Fast, minimum storage ray/triangle intersection".
bool meets_triangle(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                    const Positions& positions, const Triangle& triangle) {
  const Eigen::Vector3d a = row3(positions, triangle[0]);
  const Eigen::Vector3d ab = row3(positions, triangle[1]) - a;
  const Eigen::Vector3d ac = row3(positions, triangle[2]) - a;
  const Eigen::Vector3d p = cross3(direction, ac);
  const double determinant = dot3(ab, p);
  if (determinant == 0) return false;
  const Eigen::Vector3d from_a = origin - a;
  const double u = dot3(from_a, p) / determinant;
  if (u < 0 || u > 1) return false;
  const Eigen::Vector3d q = cross3(from_a, ab);
  const double v = dot3(direction, q) / determinant;
  return v >= 0 && u + v <= 1 && dot3(ac, q) / determinant > 0;
}

/// Whether a ray meets a box (slabs, Kay & Kajiya 1986).
template <class Box>
bool meets_box(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, const Box& box) {
  double near = 0, far = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    const auto axis = static_cast<Index>(c);
    const double low = box.low[c] - origin[axis], high = box.high[c] - origin[axis];
    if (direction[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / direction[axis], b = high / direction[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

}  // namespace

TriangleScene::TriangleScene(const std::vector<Triangle>& triangles, const TriangleTree& tree,
                             const Positions& positions, double margin)
    : triangles_(triangles),
      tree_(tree),
      positions_(positions),
      leaves_((tree.order.size() + kLeaf - 1) / kLeaf),
      boxes_(tree.nodes.size()) {
  constexpr float kEnd = std::numeric_limits<float>::infinity();
  constexpr std::size_t kLeavesATask = 512;
  parallel_for_each(leaves_.size(), kLeavesATask, [&](std::size_t leaf) {
    LeafBoxes& boxes = leaves_[leaf];
    for (std::size_t i = 0; i < kLeaf; ++i) {
      const std::size_t place = leaf * kLeaf + i;
      for (std::size_t c = 0; c < 3; ++c) {
        boxes.low[c][i] = kEnd;
        boxes.high[c][i] = -kEnd;
        if (place >= tree.order.size()) continue;
        const Triangle& t = triangles[tree.order[place]];
        const auto axis = static_cast<Index>(c);
        const double x = positions(t[0], axis), y = positions(t[1], axis);
        const double z = positions(t[2], axis);
        const float low = static_cast<float>(std::min({x, y, z}) - margin);
        const float high = static_cast<float>(std::max({x, y, z}) + margin);
        boxes.low[c][i] = low - 1e-6F * std::abs(low);
        boxes.high[c][i] = high + 1e-6F * std::abs(high);
      }
    }
  });
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    const TriangleTree::Node& node = tree.nodes[n];
    if (node.right == 0) {
      boxes_[n] = box_of(leaves_[node.begin / kLeaf]);
      continue;
    }
    const Box &left = boxes_[n + 1], &right = boxes_[node.right];
    for (std::size_t c = 0; c < 3; ++c) {
      boxes_[n].low[c] = std::min(left.low[c], right.low[c]);
      boxes_[n].high[c] = std::max(left.high[c], right.high[c]);
    }
  }
}

TriangleScene::Box TriangleScene::box_of(const LeafBoxes& leaf) const {
  Box box;
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] = *std::min_element(leaf.low[c].begin(), leaf.low[c].end());
    box.high[c] = *std::max_element(leaf.high[c].begin(), leaf.high[c].end());
  }
  return box;
}

bool TriangleScene::overlap(const NodePair& pair) const {
  const Box &a = boxes_[pair.a], &b = boxes_[pair.b];
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] &&
         b.low[1] <= a.high[1] && a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

/// The pairs of children that have to be looked at in place of a pair that is not of two leaves.
void TriangleScene::split(const NodePair& pair, std::vector<NodePair>& into) const {
  const TriangleTree::Node &a = tree_.nodes[pair.a], &b = tree_.nodes[pair.b];
  const auto add = [&](std::uint32_t first, std::uint32_t second) {
    if (overlap({first, second})) into.push_back({first, second});
  };
  if (pair.a == pair.b) {
    add(pair.a + 1, pair.a + 1);
    add(a.right, a.right);
    add(pair.a + 1, a.right);
  } else if (a.end - a.begin >= b.end - b.begin) {
    add(pair.a + 1, pair.b);
    add(a.right, pair.b);
  } else {
    add(pair.a, pair.b + 1);
    add(pair.a, b.right);
  }
}

void TriangleScene::compare_leaves(const NodePair& pair, std::vector<TrianglePair>& found) const {
  const TriangleTree::Node &a = tree_.nodes[pair.a], &b = tree_.nodes[pair.b];
  const LeafBoxes &in_a = leaves_[a.begin / kLeaf], &in_b = leaves_[b.begin / kLeaf];
  for (std::uint32_t i = 0; i < a.end - a.begin; ++i) {
    std::array<std::int32_t, kLeaf> near;
    near.fill(1);
    for (std::size_t c = 0; c < 3; ++c) {
      const float low = in_a.low[c][i], high = in_a.high[c][i];
      for (std::size_t j = 0; j < kLeaf; ++j) {
        near[j] &= static_cast<std::int32_t>(low <= in_b.high[c][j]) &
                   static_cast<std::int32_t>(in_b.low[c][j] <= high);
      }
    }
    const std::uint32_t t = tree_.order[a.begin + i];
    for (std::uint32_t j = pair.a == pair.b ? i + 1 : 0; j < b.end - b.begin; ++j) {
      if (near[j] == 0) continue;
      const std::uint32_t other = tree_.order[b.begin + j];
      if (!share_vertex(triangles_[t], triangles_[other])) {
        found.emplace_back(std::min(t, other), std::max(t, other));
      }
    }
  }
}

std::vector<TrianglePair> TriangleScene::near_pairs() const {
  if (tree_.nodes.empty()) return {};
  const auto are_leaves = [&](const NodePair& pair) {
    return tree_.nodes[pair.a].right == 0 && tree_.nodes[pair.b].right == 0;
  };
  constexpr std::size_t kTasks = 64;
  std::vector<NodePair> tasks = {{0, 0}};
  for (bool is_split = true; is_split && tasks.size() < kTasks;) {
    is_split = false;
    std::vector<NodePair> finer;
    for (const NodePair& pair : tasks) {
      if (are_leaves(pair)) {
        finer.push_back(pair);
      } else {
        split(pair, finer);
        is_split = true;
      }
    }
    tasks = std::move(finer);
  }
  std::vector<std::vector<TrianglePair>> found(tasks.size());
  parallel_for_each(tasks.size(), [&](std::size_t t) {
    std::vector<NodePair> waiting = {tasks[t]};
    while (!waiting.empty()) {
      const NodePair pair = waiting.back();
      waiting.pop_back();
      if (are_leaves(pair)) {
        compare_leaves(pair, found[t]);
      } else {
        split(pair, waiting);
      }
    }
  });
  std::vector<TrianglePair> pairs;
  for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool TriangleScene::meets(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                          std::uint32_t start) const {
  std::vector<std::uint32_t> waiting;
  if (!tree_.nodes.empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const std::uint32_t n = waiting.back();
    waiting.pop_back();
    if (!meets_box(origin, direction, boxes_[n])) continue;
    const TriangleTree::Node& node = tree_.nodes[n];
    if (node.right != 0) {
      waiting.push_back(node.right);
      waiting.push_back(n + 1);
      continue;
    }
    for (std::uint32_t place = node.begin; place < node.end; ++place) {
      const std::uint32_t t = tree_.order[place];
      if (t != start && meets_triangle(origin, direction, positions_, triangles_[t])) return true;
    }
  }
  return false;
}

}  // namespace crowdface
