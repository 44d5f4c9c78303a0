// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/surface_tree.h"

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kMostInLeaf = 4;
constexpr std::size_t kDeepestTree = 64;  // of a tree that is halved at every level

}  // namespace

SurfaceHit nearest_on_triangle(const Positions& positions, const Triangle& corners,
                               const Eigen::Vector3d& point) {
  const Eigen::Vector3d a = row3(positions, corners[0]), b = row3(positions, corners[1]),
                        c = row3(positions, corners[2]);
  const auto [u, v, w] = nearest_in_triangle(a, b, c, point);
  SurfaceHit hit;
  hit.shares = {std::max(0.0, 1 - v - w), v, w};
  hit.point = a + v * (b - a) + w * (c - a);
  hit.distance = (point - hit.point).norm();
  return hit;
}

SurfaceTree::SurfaceTree(const Positions& positions, const std::vector<Triangle>& triangles)
    : positions_(positions), triangles_(triangles) {
  const Positions normals = vertex_normals_or_zero(triangles, positions);
  Positions centres(static_cast<Index>(triangles.size()), 3);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    facing_.push_back((row3(normals, a) + row3(normals, b) + row3(normals, c)).normalized());
    centres.row(t) = positions.row(a) + positions.row(b) + positions.row(c);
    if (!area_vector(positions, triangles[t]).normalized().isZero()) order_.push_back(t);
  }
  nodes_.reserve(order_.size());
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()), centres);
}

void SurfaceTree::build(std::uint32_t begin, std::uint32_t end, const Positions& centres) {
  const std::size_t n = nodes_.size();
  nodes_.push_back({{}, Eigen::Vector3d::Zero(), 1, 0, begin, end});
  Eigen::AlignedBox3d middles;
  for (std::uint32_t i = begin; i < end; ++i) {
    middles.extend(row3(centres, order_[i]));
    for (const std::uint32_t v : triangles_[order_[i]]) nodes_[n].box.extend(row3(positions_, v));
  }
  find_cone(nodes_[n]);
  if (end - begin <= kMostInLeaf) return;
  Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = centres(a, axis), y = centres(b, axis);
                     return x < y || (x == y && a < b);
                   });
  build(begin, middle, centres);
  nodes_[n].second = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end, centres);
}

void SurfaceTree::find_cone(Node& node) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::uint32_t i = node.begin; i < node.end; ++i) sum += facing_[order_[i]];
  node.axis = sum.normalized();
  node.cosine = 1;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    node.cosine = std::min(node.cosine, node.axis.dot(facing_[order_[i]]));
  }
  node.cosine = std::max(-1.0, node.cosine - 1e-9);
  node.sine = std::sqrt(1 - node.cosine * node.cosine);
}

template <class AcceptNode, class Accept>
SurfaceHit SurfaceTree::search(const Eigen::Vector3d& point, const SurfaceHit& start,
                               const AcceptNode& accept_node, const Accept& accept) const {
  struct Waiting {
    std::uint32_t node;
    double squared;
  };
  SurfaceHit best = start;
  if (nodes_.empty()) return best;
  std::array<Waiting, kDeepestTree> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, nodes_[0].box.squaredExteriorDistance(point)};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.squared > best.distance * best.distance) continue;
    const Node& node = nodes_[next.node];
    if (!accept_node(node)) continue;
    if (node.second != 0) {
      Waiting near = {next.node + 1, nodes_[next.node + 1].box.squaredExteriorDistance(point)};
      Waiting far = {node.second, nodes_[node.second].box.squaredExteriorDistance(point)};
      if (far.squared < near.squared) std::swap(near, far);
      stack[waiting++] = far;
      stack[waiting++] = near;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t t = order_[i];
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

SurfaceHit SurfaceTree::on_triangle(std::uint32_t triangle, const Eigen::Vector3d& point,
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
  return search(
      point, on_triangle(guess, point, reach), [](const Node&) { return true; },
      [](std::uint32_t) { return true; });
}

SurfaceHit SurfaceTree::nearest_facing(const Eigen::Vector3d& point, const Eigen::Vector3d& facing,
                                       double least_cosine, double reach,
                                       std::uint32_t guess) const {
  const auto accept = [&](std::uint32_t t) { return facing_[t].dot(facing) >= least_cosine; };
  // The angle to the axis is at most the cone's plus that of least_cosine.
  const double least_sine = std::sqrt(1 - least_cosine * least_cosine);
  const auto accept_node = [&](const Node& node) {
    if (node.cosine <= -least_cosine) return true;  // together 180° or more
    return node.axis.dot(facing) >= node.cosine * least_cosine - node.sine * least_sine;
  };
  if (guess != kNoIndex && !accept(guess)) guess = kNoIndex;
  return search(point, on_triangle(guess, point, reach), accept_node, accept);
}

}  // namespace crowdface
