// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/likeness.h"

#include <algorithm>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::ptrdiff_t kBlock = 64;

std::vector<double> distances_from(const std::vector<FaceSpace::Place>& places, std::size_t face) {
  std::vector<double> mm(places.size());
  const auto count = static_cast<std::ptrdiff_t>(places.size());
  parallel_blocks(count, 16 * kBlock, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      const auto other = static_cast<std::size_t>(i);
      mm[other] = FaceSpace::distance(places[face], places[other]);
    }
  });
  return mm;
}

std::vector<Neighbour> nearest_of(const std::vector<FaceSpace::Place>& places, std::size_t face,
                                  std::size_t count) {
  std::vector<Neighbour> near;
  for (std::size_t other = 0; other < places.size(); ++other) {
    if (other == face) continue;
    const double mm = FaceSpace::distance(places[face], places[other]);
    if (near.size() == count && mm >= near.back().mm) continue;
    const auto at = std::upper_bound(near.begin(), near.end(), mm,
                                     [](double value, const Neighbour& n) { return value < n.mm; });
    near.insert(at, {other, mm});
    if (near.size() > count) near.pop_back();
  }
  return near;
}

std::vector<std::size_t> walk(const std::vector<FaceSpace::Place>& places) {
  std::vector<std::size_t> order;
  std::vector<bool> met(places.size(), false);
  const std::vector<double> from_first = distances_from(places, 0);
  auto at = static_cast<std::size_t>(std::max_element(from_first.begin(), from_first.end()) -
                                     from_first.begin());
  while (true) {
    met[at] = true;
    order.push_back(at);
    if (order.size() == places.size()) return order;
    const std::vector<double> mm = distances_from(places, at);
    std::size_t next = places.size();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!met[i] && (next == places.size() || mm[i] < mm[next])) next = i;
    }
    at = next;
  }
}

}  // namespace

Likeness find_likeness(const std::vector<FaceSpace::Place>& places, std::size_t neighbours) {
  Likeness likeness;
  if (places.empty()) return likeness;
  likeness.order = walk(places);
  likeness.near.resize(places.size());
  if (neighbours == 0) return likeness;
  const auto count = static_cast<std::ptrdiff_t>(places.size());
  parallel_blocks(count, kBlock, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      const auto face = static_cast<std::size_t>(i);
      likeness.near[face] = nearest_of(places, face, neighbours);
    }
  });
  return likeness;
}

}  // namespace crowdface
