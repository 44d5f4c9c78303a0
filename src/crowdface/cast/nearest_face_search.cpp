// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/nearest_face_search.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "crowdface/smooth/columns.h"

namespace crowdface {
namespace {

/// up to this number of points, a linear search is as fast as building a tree and searching it
constexpr Index kMaxNewestPoints = 512;
constexpr std::uint32_t kLeafSize = 4 * PointBlocks::kLanes;

}  // namespace

PointTree::PointTree(Index dimensions, const std::vector<const PointBlocks*>& points)
    : points_(dimensions) {
  std::vector<std::pair<const PointBlocks*, Index>> sources;
  for (const PointBlocks* blocks : points) {
    for (Index at = 0; at < blocks->size(); ++at) sources.emplace_back(blocks, at);
  }
  Columns leading(static_cast<Index>(sources.size()), LeadingCoordinatesBox::kDimensions);
  std::vector<std::uint32_t> rows(sources.size());
  std::iota(rows.begin(), rows.end(), 0U);
  for (const std::uint32_t row : rows) {
    const auto& [blocks, at] = sources[row];
    for (Index d = 0; d < leading.cols(); ++d) leading(row, d) = blocks->coordinate(at, d);
  }
  tree_ = MedianSplitTree(std::move(rows), leading, kLeafSize);
  std::vector<float> values(static_cast<std::size_t>(points_.padded_dimensions()));
  for (const std::uint32_t row : tree_.order) {
    const auto& [blocks, at] = sources[row];
    for (std::size_t d = 0; d < values.size(); ++d) {
      values[d] = blocks->coordinate(at, static_cast<Index>(d));
    }
    points_.add(blocks->point_number(at), values.data());
  }
  for (const auto& [begin, end, second] : tree_.nodes) {
    Bounds bounds{{}, points_.point_number(begin), points_.point_number(begin)};
    for (std::size_t d = 0; d < LeadingCoordinatesBox::kDimensions; ++d) {
      bounds.box.low[d] = bounds.box.high[d] = points_.coordinate(begin, static_cast<Index>(d));
    }
    for (Index at = begin; at < end; ++at) {
      bounds.min_point_number = std::min(bounds.min_point_number, points_.point_number(at));
      bounds.max_point_number = std::max(bounds.max_point_number, points_.point_number(at));
      for (std::size_t d = 0; d < LeadingCoordinatesBox::kDimensions; ++d) {
        const float value = points_.coordinate(at, static_cast<Index>(d));
        bounds.box.low[d] = std::min(bounds.box.low[d], value);
        bounds.box.high[d] = std::max(bounds.box.high[d], value);
      }
    }
    bounds_.push_back(bounds);
  }
}

void PointTree::search(const std::vector<float>& query, Index begin, Index end,
                       double sufficient_squared_distance, NearestPoint& best) const {
  const auto wanted = [&](float squared, const Bounds& node) {
    return !(best.squared_distance < sufficient_squared_distance) && node.min_point_number < end &&
           node.max_point_number >= begin &&
           static_cast<double>(squared) * (1 - PointBlocks::kRoundingTolerance) <=
               best.squared_distance;
  };
  visit(query, wanted, [&](Index block) { points_.search(query, block, begin, end, best); });
}

void GrowingPointSet::add(const Eigen::VectorXf& point) {
  newest_points_.add(size_++, newest_points_.padded_query(point).data());
  if (newest_points_.size() < kMaxNewestPoints) return;
  // Merge the newest points with the last tree, then with the second last tree, and so on, as long
  // as the next tree contains no more points than the merged set.
  std::vector<const PointBlocks*> joined = {&newest_points_};
  Index count = newest_points_.size();
  std::size_t kept = trees_.size();
  while (kept > 0 && trees_[kept - 1].points().size() <= count) {
    joined.push_back(&trees_[--kept].points());
    count += joined.back()->size();
  }
  PointTree tree(dimensions_, joined);
  trees_.erase(trees_.begin() + static_cast<std::ptrdiff_t>(kept), trees_.end());
  trees_.push_back(std::move(tree));
  newest_points_.clear();
}

NearestPoint GrowingPointSet::nearest(const Eigen::VectorXf& query, double limit_squared,
                                      Index begin, Index end,
                                      double sufficient_squared_distance) const {
  NearestPoint best{-1, limit_squared};
  const std::vector<float> padded = newest_points_.padded_query(query);
  for (const PointTree& tree : trees_) {
    tree.search(padded, begin, end, sufficient_squared_distance, best);
    if (best.point >= 0 && best.squared_distance < sufficient_squared_distance) return best;
  }
  const Index first_newest = size_ - newest_points_.size();
  const Index last = std::min(end - first_newest, newest_points_.size());
  for (Index block = std::max(begin - first_newest, Index{0}) / PointBlocks::kLanes;
       block * PointBlocks::kLanes < last; ++block) {
    newest_points_.search(padded, block, begin, end, best);
  }
  return best;
}

void NearestFaceSearch::add(const FaceSpace::Point& point) {
  points_with_extrapolation_.add(point.coordinates_with_extrapolation);
  points_without_extrapolation_.add(point.coordinates_without_extrapolation);
  has_extrapolated_faces_ = has_extrapolated_faces_ || point.coordinates_with_extrapolation !=
                                                           point.coordinates_without_extrapolation;
}

NearestFaceSearch::NearestFace NearestFaceSearch::nearest(const FaceSpace::Point& point,
                                                          double limit_mm, Index begin, Index end,
                                                          double sufficient_distance_mm) const {
  if (end < 0) end = size();
  const double sufficient_squared_distance = sufficient_distance_mm * sufficient_distance_mm;
  NearestPoint hit =
      points_with_extrapolation_.nearest(point.coordinates_with_extrapolation, limit_mm * limit_mm,
                                         begin, end, sufficient_squared_distance);
  const bool done = hit.point >= 0 && hit.squared_distance < sufficient_squared_distance;
  if (!done && (has_extrapolated_faces_ ||
                point.coordinates_with_extrapolation != point.coordinates_without_extrapolation)) {
    const NearestPoint other = points_without_extrapolation_.nearest(
        point.coordinates_without_extrapolation, hit.squared_distance, begin, end,
        sufficient_squared_distance);
    if (other.point >= 0) hit = other;
  }
  if (hit.point < 0) return {};
  return {hit.point, std::sqrt(hit.squared_distance)};
}

}  // namespace crowdface
