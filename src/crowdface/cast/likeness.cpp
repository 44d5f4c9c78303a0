// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/likeness.h"

#include <algorithm>

#include "crowdface/cast/likeness_tree.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::size_t kBlock = 64;

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
