// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_samples.h"

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/normals.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

constexpr int kTrajectorySteps = 63;

/// The area of the faces around each vertex of the face, shared out among their corners.
std::vector<double> face_areas(const Topology& topology, const Components& components,
                               const Positions& mean, Axis front) {
  const std::uint32_t skin = components.largest();
  const auto on_skin = [&](Index i) {
    return components.of_vertex[static_cast<std::size_t>(i)] == skin;
  };
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (Index i = 0; i < mean.rows(); ++i) {
    if (!on_skin(i)) continue;
    low = std::min(low, front.sign * mean(i, front.index));
    high = std::max(high, front.sign * mean(i, front.index));
  }
  const double middle = 0.5 * (low + high);
  std::vector<double> areas(static_cast<std::size_t>(mean.rows()), 0.0);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Eigen::Vector3d area = face_area_vector(topology, f, mean);
    const auto face = topology.face(f);
    const double share = std::sqrt(area.squaredNorm()) / static_cast<double>(face.size());
    for (const std::uint32_t i : face) {
      if (on_skin(i) && front.sign * mean(i, front.index) >= middle) areas[i] += share;
    }
  }
  return areas;
}

}  // namespace

FaceSamples choose_face_samples(const Topology& topology, const Components& components,
                                const Positions& mean, Axis front, Index count) {
  const std::vector<double> areas = face_areas(topology, components, mean, front);
  double total = 0;
  for (const double area : areas) total += area;
  // Systematic sampling: one step along the summed area, one sample.
  const double step = total / static_cast<double>(count);
  FaceSamples samples;
  double sum = 0, next = 0.5 * step;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    sum += areas[i];
    if (areas[i] == 0 || sum < next) continue;
    samples.push_back(static_cast<std::uint32_t>(i));
    while (next <= sum) next += step;  // a vertex is taken once, however large its share
  }
  return samples;
}

std::vector<std::uint64_t> trajectory_levels(std::uint64_t max_level) {
  return levels_dense_at_start(max_level, kTrajectorySteps);
}

Trajectory sample_trajectory(const ChebyshevFilter& filter, const LevelNodes& nodes,
                             const NodeFields& fields, const FaceSamples& samples) {
  const std::vector<std::uint64_t> levels = trajectory_levels(nodes.max_level());
  Trajectory trajectory =
      Trajectory::Zero(static_cast<Index>(levels.size()), 3 * static_cast<Index>(samples.size()));
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const std::vector<double> weights = nodes.weights(levels[l]);
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

}  // namespace crowdface
