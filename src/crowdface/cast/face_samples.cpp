// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_samples.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "crowdface/cast/compared_area.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

constexpr int kTrajectorySteps = 63;

/// Returns for each vertex the density of samples; all densities sum to one.
std::vector<double> sampling_density(const Topology& topology, const Components& components,
                                     const Positions& mean, Axis front) {
  const std::vector<double> face =
      compared_vertex_areas(topology, components, mean, ComparedArea::kFront, front);
  const std::vector<double> skin =
      compared_vertex_areas(topology, components, mean, ComparedArea::kSkin, front);
  std::vector<double> vertices;
  for (const double area : skin) vertices.push_back(area > 0 ? 1 : 0);
  std::vector<double> density(skin.size(), 0.0);
  const auto add = [&](const std::vector<double>& part, double share) {
    double total = 0;
    for (const double value : part) total += value;
    if (total == 0) return;
    for (std::size_t i = 0; i < part.size(); ++i) density[i] += share * part[i] / total;
  };
  add(face, 0.5);
  add(skin, 0.25);
  add(vertices, 0.25);
  return density;
}

/// Returns the vertices in the order of a space-filling curve (Morton 1966). Vertices that are
/// adjacent in this order are mostly close to each other in space.
std::vector<std::uint32_t> order_along_curve(const Positions& mean) {
  constexpr std::uint64_t kCells = 1 << 16;
  const Eigen::RowVector3d low = mean.colwise().minCoeff();
  const double size = std::max((mean.colwise().maxCoeff() - low).maxCoeff(), 1e-300);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> coded;
  coded.reserve(static_cast<std::size_t>(mean.rows()));
  for (Index i = 0; i < mean.rows(); ++i) {
    std::uint64_t code = 0;
    for (int c = 0; c < 3; ++c) {
      const double at = (mean(i, c) - low(c)) / size * static_cast<double>(kCells - 1);
      const auto cell = static_cast<std::uint64_t>(at);
      for (int bit = 0; bit < 16; ++bit) {
        code |= (cell >> bit & 1U) << (3 * bit + c);
      }
    }
    coded.emplace_back(code, static_cast<std::uint32_t>(i));
  }
  std::sort(coded.begin(), coded.end());
  std::vector<std::uint32_t> order;
  order.reserve(coded.size());
  for (const auto& entry : coded) order.push_back(entry.second);
  return order;
}

}  // namespace

FaceSamples choose_face_samples(const Topology& topology, const Components& components,
                                const Positions& mean, Axis front, Index count) {
  const std::vector<double> density = sampling_density(topology, components, mean, front);
  // Systematic sampling: take one sample whenever the cumulative density has grown by `step`.
  const double step = 1 / static_cast<double>(count);
  FaceSamples samples;
  double sum = 0, next = 0.5 * step;
  for (const std::uint32_t i : order_along_curve(mean)) {
    sum += density[i];
    if (density[i] == 0 || sum < next) continue;
    samples.push_back(i);
    // a vertex is taken only once, even if its density exceeds the step
    while (next <= sum) next += step;
  }
  std::sort(samples.begin(), samples.end());
  return samples;
}

FaceSamples samples_and_mirror_images(const FaceSamples& samples, const MirrorMap& mirror) {
  std::set<std::uint32_t> all(samples.begin(), samples.end());
  for (const std::uint32_t v : samples) {
    if (mirror.has_mirror_vertex(v)) all.insert(mirror.corners[v][0]);
  }
  return {all.begin(), all.end()};
}

FaceSamples samples_and_mirror_corners(FaceSamples samples, const MirrorMap& mirror) {
  const std::set<std::uint32_t> known(samples.begin(), samples.end());
  std::set<std::uint32_t> more;
  for (const std::uint32_t v : known) {
    for (const std::uint32_t corner : mirror.corners[v]) {
      if (!known.contains(corner)) more.insert(corner);
    }
  }
  samples.insert(samples.end(), more.begin(), more.end());
  return samples;
}

std::vector<std::uint64_t> stored_smoothing_levels(std::uint64_t max_level) {
  return levels_dense_at_start(max_level, kTrajectorySteps);
}

Trajectory sample_smoothing_trajectory(const ChebyshevFilter& filter, const LevelNodes& nodes,
                                       const NodeFields& fields, const FaceSamples& samples) {
  const std::vector<std::uint64_t> levels = stored_smoothing_levels(nodes.max_level());
  Trajectory trajectory =
      Trajectory::Zero(static_cast<Index>(levels.size()), 3 * static_cast<Index>(samples.size()));
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const std::vector<double> weights = nodes.interpolation_weights(levels[l]);
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const std::uint32_t row = filter.row_of_vertex()[samples[s]];
      for (Index c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t n = 0; n < weights.size(); ++n) {
          sum += weights[n] * static_cast<double>(fields.displacements[n][row].value[c]);
        }
        trajectory(static_cast<Index>(l), 3 * static_cast<Index>(s) + c) = static_cast<float>(sum);
      }
    }
  }
  return trajectory;
}

std::vector<WeightedTrajectoryRow> interpolation_rows(const std::vector<std::uint64_t>& levels,
                                                      std::uint64_t level) {
  const auto upper = std::upper_bound(levels.begin(), levels.end(), level);
  const Index high = std::min<Index>(upper - levels.begin(), static_cast<Index>(levels.size()) - 1);
  const Index low = std::max<Index>(high - 1, 0);
  const auto root = [](std::uint64_t value) { return std::sqrt(static_cast<double>(value)); };
  const double from = root(levels[static_cast<std::size_t>(low)]);
  const double to = root(levels[static_cast<std::size_t>(high)]);
  const double t = to > from ? std::clamp((root(level) - from) / (to - from), 0.0, 1.0) : 0.0;
  if (t == 0) return {{low, 1}};
  if (t == 1) return {{high, 1}};
  return {{low, 1 - t}, {high, t}};
}

}  // namespace crowdface
