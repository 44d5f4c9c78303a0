// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_point_index.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace crowdface {
namespace {

/// searching this many points in order is as fast as searching a tree
constexpr Index kNewest = 2048;
constexpr std::size_t kLeaf = 2 * PointBlocks::kLanes;

}  // namespace

/// The points of a new tree, their leading coordinates, and their order in the tree.
struct PointTree::Building {
  std::vector<std::array<float, LeadingBox::kDimensions>> leading;
  std::vector<std::pair<const PointBlocks*, Index>> sources;
  std::vector<std::size_t> order;

  Index number(std::size_t at) const { return sources[at].first->number(sources[at].second); }
};

PointTree::PointTree(Index dimensions, const std::vector<const PointBlocks*>& points)
    : points_(dimensions) {
  Building building;
  for (const PointBlocks* blocks : points) {
    for (Index at = 0; at < blocks->size(); ++at) {
      auto& leading = building.leading.emplace_back();
      for (std::size_t d = 0; d < LeadingBox::kDimensions; ++d) {
        leading[d] = blocks->value(at, static_cast<Index>(d));
      }
      building.sources.emplace_back(blocks, at);
    }
  }
  building.order.resize(building.leading.size());
  std::iota(building.order.begin(), building.order.end(), std::size_t{0});
  build(building, 0, building.order.size());
  std::vector<float> values(static_cast<std::size_t>(points_.padded_dimensions()));
  for (const std::size_t at : building.order) {
    const auto& [blocks, source] = building.sources[at];
    for (std::size_t d = 0; d < values.size(); ++d) {
      values[d] = blocks->value(source, static_cast<Index>(d));
    }
    points_.add(building.number(at), values.data());
  }
}

std::int32_t PointTree::build(Building& building, std::size_t begin, std::size_t end) {
  const auto at = static_cast<std::int32_t>(nodes_.size());
  Node node;
  LeadingBox& box = node.box;
  const auto first = building.order.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = building.order.begin() + static_cast<std::ptrdiff_t>(end);
  const auto [least, greatest] = std::minmax_element(
      first, last, [&](auto a, auto b) { return building.number(a) < building.number(b); });
  node.least = building.number(*least);
  node.greatest = building.number(*greatest);
  std::size_t widest = 0;
  for (std::size_t d = 0; d < LeadingBox::kDimensions; ++d) {
    const auto [low, high] = std::minmax_element(first, last, [&](auto a, auto b) {
      return building.leading[a][d] < building.leading[b][d];
    });
    box.low[d] = building.leading[*low][d];
    box.high[d] = building.leading[*high][d];
    if (box.high[d] - box.low[d] > box.high[widest] - box.low[widest]) widest = d;
  }
  nodes_.push_back(node);
  if (end - begin <= kLeaf) {
    nodes_.back().block = static_cast<std::int32_t>(begin / PointBlocks::kLanes);
    nodes_.back().blocks =
        static_cast<std::int32_t>((end - begin + PointBlocks::kLanes - 1) / PointBlocks::kLanes);
    return at;
  }
  // Split at a multiple of the leaf size, so that each leaf begins with a whole block.
  const std::size_t middle = begin + std::max(std::size_t{1}, (end - begin) / 2 / kLeaf) * kLeaf;
  std::nth_element(first, building.order.begin() + static_cast<std::ptrdiff_t>(middle), last,
                   [&](auto a, auto b) {
                     const float left = building.leading[a][widest];
                     const float right = building.leading[b][widest];
                     return left != right ? left < right : building.number(a) < building.number(b);
                   });
  const std::int32_t left = build(building, begin, middle);
  const std::int32_t right = build(building, middle, end);
  nodes_[static_cast<std::size_t>(at)].left = left;
  nodes_[static_cast<std::size_t>(at)].right = right;
  return at;
}

void PointTree::search(const std::vector<float>& query, Index begin, Index end, double enough,
                       NearestPoint& best) const {
  const auto wanted = [&](float squared, const Node& node) {
    return !(best.squared < enough) && node.least < end && node.greatest >= begin &&
           static_cast<double>(squared) * (1 - PointBlocks::kRounding) <= best.squared;
  };
  visit(query, wanted, [&](Index block) { points_.search(query, block, begin, end, best); });
}

void PointTrees::add(const Eigen::VectorXf& point) {
  newest_.add(size_++, newest_.padded(point).data());
  if (newest_.size() < kNewest) return;
  // Merge the newest points with all trees that are not larger.
  std::vector<const PointBlocks*> joined = {&newest_};
  Index count = newest_.size();
  std::size_t kept = trees_.size();
  while (kept > 0 && trees_[kept - 1].points().size() <= count) {
    joined.push_back(&trees_[--kept].points());
    count += joined.back()->size();
  }
  PointTree tree(dimensions_, joined);
  trees_.erase(trees_.begin() + static_cast<std::ptrdiff_t>(kept), trees_.end());
  trees_.push_back(std::move(tree));
  newest_.clear();
}

NearestPoint PointTrees::nearest(const Eigen::VectorXf& query, double limit, Index begin, Index end,
                                 double enough) const {
  NearestPoint best{-1, limit};
  const std::vector<float> padded = newest_.padded(query);
  for (const PointTree& tree : trees_) {
    tree.search(padded, begin, end, enough, best);
    if (best.point >= 0 && best.squared < enough) return best;
  }
  const Index first_newest = size_ - newest_.size();
  const Index last = std::min(end - first_newest, newest_.size());
  for (Index block = std::max(begin - first_newest, Index{0}) / PointBlocks::kLanes;
       block * PointBlocks::kLanes < last; ++block) {
    newest_.search(padded, block, begin, end, best);
  }
  return best;
}

void FacePointIndex::add(const FaceSpace::Point& point) {
  as_built_.add(point.as_built);
  unit_.add(point.unit);
  extrapolated_ = extrapolated_ || point.as_built != point.unit;
}

FacePointIndex::Nearest FacePointIndex::nearest(const FaceSpace::Point& point, double limit_mm,
                                                Index begin, Index end, double enough_mm) const {
  if (end < 0) end = size();
  const double enough = enough_mm * enough_mm;
  NearestPoint hit = as_built_.nearest(point.as_built, limit_mm * limit_mm, begin, end, enough);
  const bool done = hit.point >= 0 && hit.squared < enough;
  if (!done && (extrapolated_ || point.as_built != point.unit)) {
    const NearestPoint other = unit_.nearest(point.unit, hit.squared, begin, end, enough);
    if (other.point >= 0) hit = other;
  }
  if (hit.point < 0) return {};
  return {hit.point, std::sqrt(hit.squared)};
}

}  // namespace crowdface
