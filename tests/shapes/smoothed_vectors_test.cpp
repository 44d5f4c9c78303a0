// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/smoothed_vectors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

const Eigen::Vector3d kHere = {0, 0, 0}, kThere = {3, 0, 0};

std::vector<SmoothedVectors::Sample> scattered(
    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& value) {
  std::mt19937 random(7);
  std::vector<SmoothedVectors::Sample> samples;
  const auto one = [&] { return static_cast<double>(random()) / 4294967295.0; };
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const Eigen::Vector3d place(8 * one() - 2.5, 4 * one() - 2, 4 * one() - 2);
    samples.push_back({i, place, value(place)});
  }
  return samples;
}

TEST(SmoothedVectors, WhatIsEvenAlreadyStays) {
  const SmoothedVectors field({kHere, kThere}, 0.5, 1, 2);
  for (const auto& change :
       field.changes(scattered([](const auto&) { return Eigen::Vector3d(1, 2, 3); }))) {
    EXPECT_LT(change.displacement.norm(), 1e-12);
  }
}

TEST(SmoothedVectors, NearItIsTheMeanAndFarAwayWhatItWas) {
  const SmoothedVectors field({kHere, kThere}, 0.5, 1, 2);
  // One in two goes up, the next one down.
  auto samples = scattered([](const auto&) { return Eigen::Vector3d::Zero().eval(); });
  for (auto& sample : samples) sample.value.z() = sample.index % 2 == 0 ? 1 : -1;
  std::vector<double> left(samples.size());
  for (const auto& sample : samples) left[sample.index] = sample.value.z();
  for (const auto& [number, by] : field.changes(samples)) left[number] += by.z();
  std::size_t near = 0, far = 0;
  for (const auto& sample : samples) {
    const double distance =
        std::min((sample.position - kHere).norm(), (sample.position - kThere).norm());
    if (distance < 1) {
      EXPECT_LT(std::abs(left[sample.index]), 0.6);
      ++near;
    } else if (distance > 2) {
      EXPECT_EQ(left[sample.index], sample.value.z());
      ++far;
    }
  }
  EXPECT_GT(near, 100U);
  EXPECT_GT(far, 100U);
}

TEST(SmoothedVectors, HearsWhatLiesWithinItsReach) {
  const SmoothedVectors field({kHere}, 0.5, 1, 2);
  EXPECT_TRUE(field.affects({2.4, 0, 0}));
  EXPECT_FALSE(field.affects({2.6, 0, 0}));
  EXPECT_FALSE(SmoothedVectors({}, 0.5, 1, 2).affects(kHere));
}

}  // namespace
}  // namespace crowdface
