// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/surface_tree.h"

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kMostInLeaf = 4;
constexpr std::size_t kDeepest = 64;  // of a tree that is halved at every level

Eigen::Vector3d corner(const Positions& positions, const Triangle& t, std::size_t k) {
  return positions.row(t[k]).transpose();
}

}  // namespace

SurfaceHit nearest_on_triangle(const Positions& positions, const Triangle& corners,
                               const Eigen::Vector3d& point) {
  const Eigen::Vector3d a = corner(positions, corners, 0), b = corner(positions, corners, 1),
                        c = corner(positions, corners, 2);
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = point - a, bp = point - b, cp = point - c;
  const double d1 = dot3(ab, ap), d2 = dot3(ac, ap), d3 = dot3(ab, bp), d4 = dot3(ac, bp),
               d5 = dot3(ab, cp), d6 = dot3(ac, cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  double v = 0, w = 0;
  if (d1 <= 0 && d2 <= 0) {
    // the first corner
  } else if (d3 >= 0 && d4 <= d3) {
    v = 1;
  } else if (d6 >= 0 && d5 <= d6) {
    w = 1;
  } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    v = d1 / (d1 - d3);
  } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    w = d2 / (d2 - d6);
  } else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    v = 1 - w;
  } else {
    v = vb / (va + vb + vc);
    w = vc / (va + vb + vc);
  }
  SurfaceHit hit;
  hit.shares = {std::max(0.0, 1 - v - w), v, w};
  hit.point = a + v * ab + w * ac;
  hit.distance = length3(point - hit.point);
  return hit;
}

double SurfaceTree::Box::squared_distance(const Eigen::Vector3d& point) const {
  double sum = 0;
  for (Index c = 0; c < 3; ++c) {
    const double outside = std::max({low(c) - point(c), point(c) - high(c), 0.0});
    sum += outside * outside;
  }
  return sum;
}

SurfaceTree::SurfaceTree(const Positions& positions, const std::vector<Triangle>& triangles)
    : positions_(positions), triangles_(triangles) {
  find_normals();
  Positions centres(static_cast<Index>(triangles.size()), 3);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (normals_[t].isZero()) continue;
    order_.push_back(t);
    centres.row(t) = (corner(positions, triangles[t], 0) + corner(positions, triangles[t], 1) +
                      corner(positions, triangles[t], 2))
                         .transpose();
  }
  nodes_.reserve(order_.size());
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()), centres);
  refit();
}

void SurfaceTree::find_normals() {
  normals_.resize(triangles_.size());
  std::vector<Eigen::Vector3d> of_vertices(static_cast<std::size_t>(positions_.rows()),
                                           Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Eigen::Vector3d a = corner(positions_, triangles_[t], 0);
    const Eigen::Vector3d area =
        cross3(corner(positions_, triangles_[t], 1) - a, corner(positions_, triangles_[t], 2) - a);
    normals_[t] = unit3(area);
    for (const std::uint32_t v : triangles_[t]) of_vertices[v] += area;
  }
  facing_.resize(triangles_.size());
  for (Eigen::Vector3d& normal : of_vertices) normal = unit3(normal);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& corners = triangles_[t];
    facing_[t] = unit3(of_vertices[corners[0]] + of_vertices[corners[1]] + of_vertices[corners[2]]);
  }
}

void SurfaceTree::build(std::uint32_t begin, std::uint32_t end, const Positions& centres) {
  const std::size_t n = nodes_.size();
  nodes_.push_back({{}, begin, end});
  if (end - begin <= kMostInLeaf) return;
  Eigen::RowVector3d low = centres.row(order_[begin]), high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    low = low.cwiseMin(centres.row(order_[i]));
    high = high.cwiseMax(centres.row(order_[i]));
  }
  Index axis = 0;
  (high - low).maxCoeff(&axis);
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

SurfaceTree::Box SurfaceTree::box_of(const Node& node) const {
  Box box{Eigen::Vector3d::Constant(1e300), Eigen::Vector3d::Constant(-1e300)};
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = corner(positions_, triangles_[order_[i]], k);
      box.low = box.low.cwiseMin(p);
      box.high = box.high.cwiseMax(p);
    }
  }
  return box;
}

void SurfaceTree::refit() {
  find_normals();
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    if (node.second == 0) {
      node.box = box_of(node);
    } else {
      const Box &a = nodes_[n + 1].box, &b = nodes_[node.second].box;
      node.box = {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
    }
  }
}

template <class Accept>
SurfaceHit SurfaceTree::search(const Eigen::Vector3d& point, double reach,
                               const Accept& accept) const {
  struct Waiting {
    std::uint32_t node;
    double squared;
  };
  SurfaceHit best;
  best.distance = reach;
  if (nodes_.empty()) return best;
  std::array<Waiting, kDeepest> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, nodes_[0].box.squared_distance(point)};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.squared > best.distance * best.distance) continue;
    const Node& node = nodes_[next.node];
    if (node.second != 0) {
      Waiting near = {next.node + 1, nodes_[next.node + 1].box.squared_distance(point)};
      Waiting far = {node.second, nodes_[node.second].box.squared_distance(point)};
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

SurfaceHit SurfaceTree::nearest(const Eigen::Vector3d& point, double reach) const {
  return search(point, reach, [](std::uint32_t) { return true; });
}

SurfaceHit SurfaceTree::nearest_facing(const Eigen::Vector3d& point, const Eigen::Vector3d& facing,
                                       double least_cosine, double reach) const {
  return search(point, reach,
                [&](std::uint32_t t) { return dot3(facing_[t], facing) >= least_cosine; });
}

}  // namespace crowdface
