// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_space.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/alignment.h"

namespace crowdface {
namespace {

/// Sum of squared differences in a fixed order, given up as soon as it exceeds `limit`.
double squared_distance(const Eigen::VectorXf& a, const Eigen::VectorXf& b, double limit) {
  constexpr Index kChunk = 256;
  double sum = 0;
  for (Index begin = 0; begin < a.size() && sum <= limit; begin += kChunk) {
    const Index end = std::min(a.size(), begin + kChunk);
    float lanes[8] = {};
    for (Index i = begin; i < end; ++i) {
      const float d = a[i] - b[i];
      lanes[i % 8] += d * d;
    }
    for (const float lane : lanes) sum += static_cast<double>(lane);
  }
  return sum;
}

double squared_distance(const FaceSpace::Place& a, const FaceSpace::Place& b, double limit) {
  const double as_built = squared_distance(a.as_built, b.as_built, limit);
  return std::min(as_built, squared_distance(a.unit, b.unit, std::min(limit, as_built)));
}

}  // namespace

FaceSpace::FaceSpace(const FaceSet& faces, const RegionWeights& regions, FaceSamples samples,
                     std::span<const Trajectory> trajectories, std::uint64_t max_level,
                     double mm_per_unit)
    : trajectories_(trajectories),
      levels_(trajectory_levels(max_level)),
      mm_per_unit_(mm_per_unit) {
  const auto count = static_cast<Index>(samples.size());
  mean_ = Positions::Zero(count, 3);
  for (const Head& head : faces.heads) {
    Positions& rows = heads_.emplace_back(count, 3);
    for (Index s = 0; s < count; ++s) {
      rows.row(s) = head.positions.row(samples[static_cast<std::size_t>(s)]);
    }
    mean_ += rows;
  }
  mean_ /= static_cast<double>(faces.heads.size());
  alpha_.resize(count, regions.alpha.cols());
  for (Index s = 0; s < count; ++s) {
    alpha_.row(s) = regions.alpha.row(samples[static_cast<std::size_t>(s)]);
  }
}

/// S_L D − D at the samples, D = B − e Σ ω̂_i C_i: between two stored levels linear in √L, in which
/// trajectories are nearly straight.
Positions FaceSpace::smoothed_difference(const RegionRecipe& region, Index target,
                                         double extrapolation) const {
  const auto upper = std::upper_bound(levels_.begin(), levels_.end(), region.iterations);
  const Index high =
      std::min<Index>(upper - levels_.begin(), static_cast<Index>(levels_.size()) - 1);
  const Index low = std::max<Index>(high - 1, 0);
  const double from = std::sqrt(static_cast<double>(levels_[static_cast<std::size_t>(low)]));
  const double to = std::sqrt(static_cast<double>(levels_[static_cast<std::size_t>(high)]));
  const double at = std::sqrt(static_cast<double>(region.iterations));
  const double t = to > from ? std::clamp((at - from) / (to - from), 0.0, 1.0) : 0.0;

  Positions sum = Positions::Zero(mean_.rows(), 3);
  const auto add = [&](Index head, double factor) {
    const Trajectory& trajectory = trajectories_[static_cast<std::size_t>(head)];
    const float* a = trajectory.data() + low * trajectory.cols();
    const float* b = trajectory.data() + high * trajectory.cols();
    double* out = sum.data();
    for (Index i = 0; i < sum.size(); ++i) {
      const double from_low = static_cast<double>(a[i]);
      out[i] += factor * (from_low + t * (static_cast<double>(b[i]) - from_low));
    }
  };
  add(target, 1);
  for (const SourceWeight& source : region.weights) {
    add(source.head, -extrapolation * source.weight);
  }
  return sum;
}

Positions FaceSpace::samples_of(const Recipe& recipe, bool unit_extrapolation) const {
  Positions samples = heads_[static_cast<std::size_t>(recipe.target)];
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    const RegionRecipe& region = recipe.regions[k];
    const Positions change =
        smoothed_difference(region, recipe.target, unit_extrapolation ? 1.0 : region.extrapolation);
    for (Index s = 0; s < samples.rows(); ++s) {
      const double alpha = alpha_(s, static_cast<Index>(k));
      for (Index c = 0; c < 3; ++c) samples(s, c) += alpha * change(s, c);  // Eq. 7
    }
  }
  return samples;
}

Eigen::VectorXf FaceSpace::aligned(const Positions& samples) const {
  const Positions moved = samples.rows() < 3
                              ? samples
                              : fit_similarity(samples, mean_, ScaleFit::kRigid).apply(samples);
  Eigen::VectorXf flat(moved.size());
  for (Index i = 0; i < moved.size(); ++i) {
    flat[i] = static_cast<float>(moved.data()[i] * mm_per_unit_);
  }
  return flat;
}

FaceSpace::Place FaceSpace::place(const Recipe& recipe) const {
  return {aligned(samples_of(recipe, false)), aligned(samples_of(recipe, true))};
}

FaceSpace::Place FaceSpace::place_head(Index head) const {
  const Eigen::VectorXf at = aligned(heads_[static_cast<std::size_t>(head)]);
  return {at, at};
}

double FaceSpace::distance(const Place& a, const Place& b) const {
  if (a.as_built.size() == 0) return 0;
  return std::sqrt(squared_distance(a, b, HUGE_VAL) * 3 / static_cast<double>(a.as_built.size()));
}

Eigen::MatrixXd FaceSpace::head_distances() const {
  const auto count = static_cast<Index>(heads_.size());
  std::vector<Place> places;
  for (Index h = 0; h < count; ++h) places.push_back(place_head(h));
  Eigen::MatrixXd distances(count, count);
  for (Index a = 0; a < count; ++a) {
    for (Index b = 0; b < count; ++b) {
      distances(a, b) =
          distance(places[static_cast<std::size_t>(a)], places[static_cast<std::size_t>(b)]);
    }
  }
  return distances;
}

void FaceSpace::find_nearest(std::vector<Recipe>& crowd) const {
  const auto faces = static_cast<Index>(crowd.size());
  std::vector<Place> heads, places(crowd.size());
  for (Index h = 0; h < static_cast<Index>(heads_.size()); ++h) heads.push_back(place_head(h));
  parallel_for_each(faces, [&](Index i) {
    places[static_cast<std::size_t>(i)] = place(crowd[static_cast<std::size_t>(i)]);
  });
  parallel_for_each(faces, [&](Index i) {
    const Place& here = places[static_cast<std::size_t>(i)];
    // Of equally near ones the first.
    const auto nearest_of = [&](const std::vector<Place>& others, Index count) {
      std::pair<Index, double> best{-1, HUGE_VAL};
      for (Index j = 0; j < count; ++j) {
        const double squared =
            squared_distance(here, others[static_cast<std::size_t>(j)], best.second);
        if (squared < best.second) best = {j, squared};
      }
      return best;
    };
    const auto to_mm = [&](double squared) {
      return std::sqrt(squared * 3 / static_cast<double>(std::max<Index>(here.as_built.size(), 1)));
    };
    Nearest nearest;
    const auto [head, head_squared] = nearest_of(heads, static_cast<Index>(heads.size()));
    nearest.head = head;
    nearest.head_mm = to_mm(head_squared);
    if (i > 0) {
      const auto [face, face_squared] = nearest_of(places, i);
      nearest.crowd = crowd[static_cast<std::size_t>(face)].id;
      nearest.crowd_mm = to_mm(face_squared);
    }
    crowd[static_cast<std::size_t>(i)].nearest = nearest;
  });
}

}  // namespace crowdface
