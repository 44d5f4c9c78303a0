// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/hair.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "head_models/synth/synthetic_head.h"

#include "support/self_crossing.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 9, kHeads = 60;
const Vector3d kForehead(0, 4.5, 9), kCheek(4.6, -3, 8), kThroat(0, -13, 5), kEarLobe(7.9, -5, -1),
    kCrown(0, 12.5, -1), kBehindEar(6, -6, -5.5);

TEST(Hair, LeavesFaceEarsAndThroatBare) {
  for (std::uint64_t h = 0; h < kHeads; ++h) {
    const Hair hair(kSeed, h);
    for (const Vector3d& place : {kForehead, kCheek, kThroat, kEarLobe}) {
      EXPECT_EQ(hair.thickness(place), 0) << "head " << h << " at " << place.transpose();
    }
    EXPECT_FALSE(hair.may_cover(kForehead)) << h;
    EXPECT_FALSE(hair.may_cover(kCheek)) << h;
  }
}

TEST(Hair, IsThickOnTheCrownUnlessItWentWithTheYears) {
  int bald = 0;
  for (std::uint64_t h = 0; h < kHeads; ++h) {
    const Hair hair(kSeed, h);
    const double receding = random_complexion(kSeed, h).recession;
    if (receding > 0.9) {
      ++bald;
      EXPECT_LT(hair.thickness(kCrown), 0.05) << h;
      EXPECT_LT(hair.coverage(kCrown, 0), 0.05) << h;
    } else if (receding < 0.3) {
      EXPECT_GT(hair.thickness(kCrown), 0.2) << h;
      EXPECT_GT(hair.coverage(kCrown, 0), 0.95) << h;
    }
  }
  EXPECT_GT(bald, 1);
}

TEST(Hair, SomeWomenWearItLongAndNoMan) {
  int women = 0;
  for (std::uint64_t h = 0; h < kHeads; ++h) {
    const bool falls = Hair(kSeed, h).thickness(kBehindEar) > 1;
    if (random_person(kSeed, h).maleness > 0) {
      EXPECT_FALSE(falls) << h;
    }
    women += falls ? 1 : 0;
  }
  EXPECT_GT(women, 5);
  EXPECT_LT(women, 20);
}

TEST(Hair, IsALayerOfTheSameMesh) {
  const SyntheticHeads bare(5000, SyntheticHeads::Parts::kEyesAndTeeth);
  const SyntheticHeads haired(5000, SyntheticHeads::Parts::kEyesAndTeeth,
                              SyntheticHeads::Scalp::kHaired);
  ASSERT_EQ(bare.topology().vertex_count, haired.topology().vertex_count);
  const Positions without = bare.positions(kSeed, 3), with = haired.positions(kSeed, 3);
  const Eigen::VectorXd moved = (with - without).cast<double>().rowwise().norm();
  EXPECT_GT(moved.maxCoeff(), 0.2);
  EXPECT_LT(moved.maxCoeff(), 5);
  EXPECT_GT((moved.array() == 0).count(), moved.size() / 3) << "the face stays to the bit";
}

TEST(Hair, DoesNotCutThroughTheSkin) {
  const SyntheticHeads heads(5000, SyntheticHeads::Parts::kSkin, SyntheticHeads::Scalp::kHaired);
  std::vector<std::size_t> crossings(kHeads);
  parallel_for_each(static_cast<std::ptrdiff_t>(kHeads), [&](std::ptrdiff_t h) {
    const auto at = static_cast<std::size_t>(h);
    crossings[at] =
        testing::find_self_crossings(heads.topology(), heads.positions(kSeed, at), 0.6).size();
  });
  for (std::size_t h = 0; h < kHeads; ++h) EXPECT_EQ(crossings[h], 0U) << "head " << h;
}

}  // namespace
}  // namespace crowdface::synth
