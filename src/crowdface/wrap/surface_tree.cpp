// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/surface_tree.h"

#include <algorithm>
#include <span>
#include <utility>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kMaxInLeaf = 4;
constexpr std::size_t kDeepestTree = 64;  // enough for a tree that halves at every level

}  // namespace

SurfaceHit nearest_on_triangle(const Positions& positions, const Triangle& corners,
                               const Eigen::Vector3d& point) {
  const Eigen::Vector3d a = row3(positions, corners[0]), b = row3(positions, corners[1]),
                        c = row3(positions, corners[2]);
  const auto [u, v, w] = nearest_in_triangle(a, b, c, point);
  SurfaceHit hit;
  hit.barycentric = {std::max(0.0, 1 - v - w), v, w};
  hit.point = a + v * (b - a) + w * (c - a);
  hit.distance = (point - hit.point).norm();
  return hit;
}

SurfaceTree::SurfaceTree(const Positions& positions, const std::vector<Triangle>& triangles)
    : positions_(positions), triangles_(triangles) {
  const Positions normals = vertex_normals_or_zero(triangles, positions);
  Positions centres(static_cast<Index>(triangles.size()), 3);
  std::vector<std::uint32_t> rows;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    mean_normals_.push_back((row3(normals, a) + row3(normals, b) + row3(normals, c)).normalized());
    centres.row(t) = positions.row(a) + positions.row(b) + positions.row(c);
    if (!area_vector(positions, triangles[t]).normalized().isZero()) rows.push_back(t);
  }
  tree_ = MedianSplitTree(std::move(rows), centres, kMaxInLeaf);
  for (const auto& [begin, end, second] : tree_.nodes) {
    Eigen::AlignedBox3d& box = boxes_.emplace_back();
    for (const std::uint32_t t : std::span(tree_.order).subspan(begin, end - begin)) {
      for (const std::uint32_t v : triangles[t]) box.extend(row3(positions, v));
    }
  }
}

template <class Accept>
SurfaceHit SurfaceTree::search(const Eigen::Vector3d& point, const SurfaceHit& start,
                               const Accept& accept) const {
  struct Waiting {
    std::uint32_t node;
    double squared;
  };
  SurfaceHit best = start;
  if (boxes_.empty()) return best;
  std::array<Waiting, kDeepestTree> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, boxes_[0].squaredExteriorDistance(point)};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.squared > best.distance * best.distance) continue;
    const MedianSplitTree::Node& node = tree_.nodes[next.node];
    if (!node.is_leaf()) {
      Waiting near = {next.node + 1, boxes_[next.node + 1].squaredExteriorDistance(point)};
      Waiting far = {node.second_child, boxes_[node.second_child].squaredExteriorDistance(point)};
      if (far.squared < near.squared) std::swap(near, far);
      stack[waiting++] = far;
      stack[waiting++] = near;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t t = tree_.order[i];
      if (!accept(t)) continue;
      SurfaceHit hit = nearest_on_triangle(positions_, triangles_[t], point);
      if (hit.distance > best.distance) continue;
      if (hit.distance == best.distance && t > best.triangle) continue;
      hit.triangle = t;
      best = hit;
    }
  }
  return best;
}

SurfaceHit SurfaceTree::hit_on_triangle(std::uint32_t triangle, const Eigen::Vector3d& point,
                                        double reach) const {
  if (triangle != kNoIndex) {
    SurfaceHit hit = nearest_on_triangle(positions_, triangles_[triangle], point);
    hit.triangle = triangle;
    if (hit.distance <= reach) return hit;
  }
  return {.distance = reach};
}

SurfaceHit SurfaceTree::nearest(const Eigen::Vector3d& point, double reach,
                                std::uint32_t guess) const {
  return search(point, hit_on_triangle(guess, point, reach), [](std::uint32_t) { return true; });
}

SurfaceHit SurfaceTree::nearest_facing(const Eigen::Vector3d& point, const Eigen::Vector3d& facing,
                                       double min_cosine, double reach, std::uint32_t guess) const {
  const auto accept = [&](std::uint32_t t) { return mean_normals_[t].dot(facing) >= min_cosine; };
  if (guess != kNoIndex && !accept(guess)) guess = kNoIndex;
  return search(point, hit_on_triangle(guess, point, reach), accept);
}

}  // namespace crowdface
