// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/likeness.h"

#include <algorithm>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::size_t kBlock = 64;

std::vector<double> distances_from(const std::vector<FaceSpace::Point>& points, std::size_t face) {
  std::vector<double> mm(points.size());
  parallel_for_each(points.size(), 16 * kBlock, [&](std::size_t other) {
    mm[other] = FaceSpace::distance(points[face], points[other]);
  });
  return mm;
}

std::vector<Neighbour> nearest_of(const std::vector<FaceSpace::Point>& points, std::size_t face,
                                  std::size_t count) {
  std::vector<Neighbour> near;
  for (std::size_t other = 0; other < points.size(); ++other) {
    if (other == face) continue;
    const double mm = FaceSpace::distance(points[face], points[other]);
    if (near.size() == count && mm >= near.back().mm) continue;
    const auto at = std::upper_bound(near.begin(), near.end(), mm,
                                     [](double value, const Neighbour& n) { return value < n.mm; });
    near.insert(at, {other, mm});
    if (near.size() > count) near.pop_back();
  }
  return near;
}

std::vector<std::size_t> walk(const std::vector<FaceSpace::Point>& points) {
  std::vector<std::size_t> order;
  std::vector<bool> met(points.size(), false);
  const std::vector<double> from_first = distances_from(points, 0);
  auto at = static_cast<std::size_t>(std::max_element(from_first.begin(), from_first.end()) -
                                     from_first.begin());
  while (true) {
    met[at] = true;
    order.push_back(at);
    if (order.size() == points.size()) return order;
    const std::vector<double> mm = distances_from(points, at);
    std::size_t next = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!met[i] && (next == points.size() || mm[i] < mm[next])) next = i;
    }
    at = next;
  }
}

}  // namespace

Likeness find_likeness(const std::vector<FaceSpace::Point>& points, std::size_t neighbours) {
  Likeness likeness;
  if (points.empty()) return likeness;
  likeness.order = walk(points);
  likeness.near.resize(points.size());
  if (neighbours == 0) return likeness;
  parallel_for_each(points.size(), kBlock, [&](std::size_t face) {
    likeness.near[face] = nearest_of(points, face, neighbours);
  });
  return likeness;
}

}  // namespace crowdface
