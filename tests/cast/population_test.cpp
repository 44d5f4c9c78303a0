// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/population.h"

#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

namespace crowdface {
namespace {

std::size_t landmark(const std::string& name) {
  std::size_t at = 0;
  for (const TraitLandmark& of : trait_landmarks()) {
    if (of.name == name) return at;
    ++at;
  }
  ADD_FAILURE() << name;
  return 0;
}

/// Landmarks of a face with this width of nose and mouth.
Positions face(double nose, double mouth) {
  Positions points = Positions::Zero(static_cast<Index>(trait_landmarks().size()), 3);
  points(static_cast<Index>(landmark("nose_wing_left")), 0) = nose;
  points(static_cast<Index>(landmark("mouth_left")), 0) = mouth;
  return points;
}

/// Draws candidates uniformly from 20 to 50 mm and takes the cheapest each time.
std::vector<double> noses_of(const std::vector<TraitTarget>& targets, std::uint64_t faces) {
  PopulationBalance population(targets);
  std::vector<double> noses;
  for (std::uint64_t i = 0; i < faces; ++i) {
    Positions best;
    double least = 0, nose = 0;
    for (std::uint64_t c = 0; c < 32; ++c) {
      const auto [a, b] = random_pair({1, i, "candidate", static_cast<std::uint32_t>(c)});
      const Positions candidate = face(20 + 30 * a, 20 + 30 * b);
      const double cost = population.cost(candidate);
      if (c > 0 && cost >= least) continue;
      least = cost;
      best = candidate;
      nose = 20 + 30 * a;
    }
    population.add(best);
    noses.push_back(nose);
  }
  return noses;
}

TEST(PopulationBalance, UniformCandidatesGetTheAskedDistribution) {
  const TraitTarget nose{*find_measurement("nose_width"), 36, 4};
  EXPECT_LT(kolmogorov_smirnov_distance(nose, noses_of({nose}, 300)), 0.02);
}

/// Once the trait out of reach outweighed the other one.
TEST(PopulationBalance, ATraitOutOfReachDoesNotSpoilTheOthers) {
  const TraitTarget nose{*find_measurement("nose_width"), 36, 4};
  const TraitTarget mouth{*find_measurement("mouth_width"), 80, 4};
  EXPECT_LT(kolmogorov_smirnov_distance(nose, noses_of({nose, mouth}, 300)), 0.05);
}

}  // namespace
}  // namespace crowdface
