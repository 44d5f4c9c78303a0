// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/smoothed_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "crowdface/core/smooth_step.h"

namespace crowdface {
namespace {

/// Averages of a vector field on a grid, with trilinear weights.
class CellMeans {
 public:
  CellMeans(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double cell)
      : low_(low), cell_(cell) {
    for (int c = 0; c < 3; ++c) {
      nodes_a_side_[static_cast<std::size_t>(c)] =
          static_cast<std::size_t>((high[c] - low[c]) / cell) + 2;
    }
    node_index_.resize(nodes_a_side_[0] * nodes_a_side_[1] * nodes_a_side_[2], kNoIndex);
  }
  void add(const Eigen::Vector3d& place, const Eigen::Vector3d& value) {
    visit(place, [&](std::size_t at, double weight) {
      if (node_index_[at] == kNoIndex) {
        node_index_[at] = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
      }
      Node& node = nodes_[node_index_[at]];
      node.sum += weight * value;
      node.weight += weight;
    });
  }
  /// Returns the average of the vectors around a position. Requires a sample in the grid cell of
  /// this position.
  Eigen::Vector3d at(const Eigen::Vector3d& place) const {
    Node mean;
    visit(place, [&](std::size_t at, double weight) {
      const Node& node = nodes_[node_index_[at]];
      mean.sum += weight * node.sum;
      mean.weight += weight * node.weight;
    });
    return mean.sum / mean.weight;
  }

 private:
  struct Node {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weight = 0;
  };

  template <class Use>
  void visit(const Eigen::Vector3d& place, const Use& use) const {
    std::array<std::size_t, 3> first;
    std::array<double, 3> t;
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = (place[static_cast<Index>(c)] - low_[static_cast<Index>(c)]) / cell_;
      first[c] = static_cast<std::size_t>(x);
      t[c] = x - static_cast<double>(first[c]);
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
      std::size_t node = 0;
      double weight = 1;
      for (std::size_t c = 3; c-- > 0;) {
        const std::size_t step = (corner >> c) & 1U;
        node = node * nodes_a_side_[c] + first[c] + step;
        weight *= step == 1 ? t[c] : 1 - t[c];
      }
      use(node, weight);
    }
  }

  Eigen::Vector3d low_;
  double cell_;
  std::array<std::size_t, 3> nodes_a_side_;
  /// for each grid node: its index in `nodes_`, which holds only the nodes with samples; kNoIndex
  /// for nodes without samples
  std::vector<std::uint32_t> node_index_;
  std::vector<Node> nodes_;
};

}  // namespace

SmoothedVectors::SmoothedVectors(std::vector<Eigen::Vector3d> centres, double cell,
                                 double inner_radius, double outer_radius)
    : centres_(std::move(centres)),
      cell_(cell),
      inner_radius_(inner_radius),
      outer_radius_(outer_radius) {
  for (const Eigen::Vector3d& place : centres_) box_.extend(place);
}

bool SmoothedVectors::may_be_near_centre(const Eigen::Vector3d& place, double reach) const {
  return (place.array() > box_.min().array() - reach).all() &&
         (place.array() < box_.max().array() + reach).all();
}

bool SmoothedVectors::affects(const Eigen::Vector3d& place) const {
  return may_be_near_centre(place, outer_radius_ + cell_);
}

double SmoothedVectors::distance_to_centre(const Eigen::Vector3d& place) const {
  double least = std::numeric_limits<double>::max();
  for (const Eigen::Vector3d& other : centres_) {
    const Eigen::Vector3d from = other - place;
    least = std::min(least, from.squaredNorm());
  }
  return std::sqrt(least);
}

std::vector<SmoothedVectors::Change> SmoothedVectors::changes(
    std::span<const Sample> samples) const {
  if (samples.empty()) return {};
  const double margin = outer_radius_ + cell_;
  CellMeans means(box_.min().array() - margin, box_.max().array() + margin, cell_);
  for (const Sample& sample : samples) means.add(sample.position, sample.value);
  std::vector<Change> changes;
  for (const Sample& sample : samples) {
    if (!may_be_near_centre(sample.position, outer_radius_)) continue;
    const double away = distance_to_centre(sample.position);
    if (away >= outer_radius_) continue;
    changes.push_back({sample.index, smooth_step(outer_radius_, inner_radius_, away) *
                                         (means.at(sample.position) - sample.value)});
  }
  return changes;
}

}  // namespace crowdface
