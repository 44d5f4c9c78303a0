// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cached_face_space.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "crowdface/cast/training_recipe.h"
#include "crowdface/core/file.h"
#include "crowdface/heads/cache_folder.h"

#include "support/forged_entry.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr Index kSamples = 60;

/// Heads whose samples move smoothly from level to level, in two regions.
HeadsAtSamples heads_at_samples(std::uint32_t seed, bool mirrored) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  HeadsAtSamples sampled;
  sampled.levels = {0, 2, 8, 32, 128};
  sampled.mean = Positions::Zero(kSamples, 3);
  for (int h = 0; h < 4; ++h) {
    Positions head(kSamples, 3);
    for (double& value : head.reshaped()) value = 50 * normal(random);
    Trajectory trajectory(5, 3 * kSamples);
    for (Index i = 0; i < 3 * kSamples; ++i) {
      const double most = normal(random), quick = 1 + std::abs(normal(random));
      for (Index l = 0; l < 5; ++l) {
        const auto level = static_cast<double>(sampled.levels[static_cast<std::size_t>(l)]);
        trajectory(l, i) = static_cast<float>(most * (1 - std::exp(-quick * level / 100)));
      }
    }
    sampled.mean += head / 4;
    sampled.heads.push_back(head);
    sampled.owned_trajectories.push_back(trajectory);
  }
  sampled.trajectories = sampled.owned_trajectories;
  sampled.region_weights = Columns(kSamples, 2);
  for (Index s = 0; s < kSamples; ++s) {
    sampled.region_weights(s, 0) = static_cast<double>(s) / kSamples;
    sampled.region_weights(s, 1) = 1 - sampled.region_weights(s, 0);
  }
  sampled.mm_per_unit = 10;
  if (mirrored)
    sampled.mirror_images = std::make_shared<HeadsAtSamples>(heads_at_samples(seed + 1, false));
  return sampled;
}

class KeptFaceSpace : public ::testing::TestWithParam<bool> {
 protected:
  static HeadsAtSamples heads(std::uint32_t seed = 1) { return heads_at_samples(seed, GetParam()); }
  FaceSpace kept(const fs::path& cache, std::uint32_t seed = 1, std::size_t bands = 2) const {
    return cached_face_space(cache, heads(seed), weights_, bands);
  }
  /// Where faces lie, and how far heads are from each other in a region.
  static std::vector<float> places(const FaceSpace& space, std::size_t bands = 2) {
    std::vector<float> all;
    for (std::uint64_t i = 0; i < 20; ++i) {
      const FaceSpace::Point at =
          space.point(random_training_recipe(space.heads_at_samples(), bands, i));
      all.insert(
          all.end(), at.coordinates_with_extrapolation.data(),
          at.coordinates_with_extrapolation.data() + at.coordinates_with_extrapolation.size());
      all.insert(all.end(), at.coordinates_without_extrapolation.data(),
                 at.coordinates_without_extrapolation.data() +
                     at.coordinates_without_extrapolation.size());
    }
    const FaceSpace::Point one = space.head_point(0), other = space.head_point(1);
    for (Index k = 0; k < 2; ++k) {
      all.push_back(static_cast<float>(
          space.region_distance(space.region_point(one, k), space.region_point(other, k), k)));
      all.push_back(static_cast<float>(space.region_area_fraction(k)));
    }
    return all;
  }
  std::size_t entries() const { return list_cache(folder_.path()).entries.size(); }

  testing::TemporaryFolder folder_;
  std::vector<double> weights_ = std::vector<double>(kSamples, 1.0 / kSamples);
};

TEST_P(KeptFaceSpace, IsTheSameToTheBitHoweverItCame) {
  const std::vector<float> made = places(FaceSpace(heads(), weights_, 2));
  EXPECT_EQ(places(kept(folder_.path())), made) << "made and kept";
  EXPECT_EQ(entries(), 1U);
  EXPECT_EQ(places(kept(folder_.path())), made) << "from the cache";
  EXPECT_EQ(places(kept({})), made) << "not kept";
  EXPECT_EQ(entries(), 1U);
}

TEST_P(KeptFaceSpace, IsAnotherOfOtherHeadsOrWeightsOrBands) {
  const std::vector<float> first = places(kept(folder_.path()));
  EXPECT_NE(places(kept(folder_.path(), 5)), first);
  EXPECT_EQ(entries(), 2U);
  kept(folder_.path(), 1, 1);
  EXPECT_EQ(entries(), 3U);
  weights_[0] = 0;
  EXPECT_NE(places(kept(folder_.path())), first);
  EXPECT_EQ(entries(), 4U);
}

TEST_P(KeptFaceSpace, IsMadeAnewWhereTheEntryIsDamaged) {
  const std::vector<float> first = places(kept(folder_.path()));
  const fs::path entry = list_cache(folder_.path()).entries.at(0);
  const auto size = fs::file_size(entry);
  fs::resize_file(entry, size - 8);
  EXPECT_EQ(places(kept(folder_.path())), first);
  EXPECT_EQ(fs::file_size(entry), size) << "mended";
}

/// An entry that is whole, and of this key, but holds what no face space has.
TEST_P(KeptFaceSpace, IsMadeAnewWhereTheEntryIsForged) {
  const std::vector<float> first = places(kept(folder_.path()));
  const fs::path entry = list_cache(folder_.path()).entries.at(0);
  const std::string sound = read_file(entry);
  const auto expect_mended = [&](const std::string& forged) {
    write_file(entry, forged);
    EXPECT_EQ(places(kept(folder_.path())), first);
    EXPECT_EQ(read_file(entry), sound);
  };
  constexpr std::size_t kColumns = 28, kRows = 32;
  for (const char* name : {"levels", "functions", "directions", "metric 0"}) {
    const std::size_t row = testing::row_of_array(sound, name);
    for (const std::uint64_t size :
         {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 63U, ~std::uint64_t{0}}) {
      expect_mended(testing::forged_at(sound, row + kRows, size));
      expect_mended(testing::forged_at(sound, row + kColumns, static_cast<std::uint32_t>(size)));
    }
    std::string other_name = sound;
    other_name[row] = 'x';
    expect_mended(testing::forged_at(other_name, row + 1, 'x'));
    expect_mended(testing::forged_array(sound, name, 0, std::numeric_limits<float>::quiet_NaN()));
  }
}

TEST_P(KeptFaceSpace, OfHeadsThatNoSmoothingMoves) {
  HeadsAtSamples still = heads();
  for (Trajectory& trajectory : still.owned_trajectories) trajectory.setZero();
  const FaceSpace first = cached_face_space(folder_.path(), still, weights_, 1);
  EXPECT_EQ(places(cached_face_space(folder_.path(), still, weights_, 1), 1), places(first, 1));
  EXPECT_EQ(entries(), 1U);
}

INSTANTIATE_TEST_SUITE_P(MirroredToo, KeptFaceSpace, ::testing::Bool());

TEST(FaceSpaceTables, FitHeadsOfTheirSizesAlone) {
  const HeadsAtSamples heads = heads_at_samples(1, false);
  const std::vector<double> weights(kSamples, 1.0 / kSamples);
  const FaceSpace space(heads, weights);
  EXPECT_TRUE(FaceSpace::have_matching_sizes(space.tables(), heads));
  EXPECT_FALSE(FaceSpace::have_matching_sizes(FaceSpaceTables(), heads));
  FaceSpaceTables fewer = space.tables();
  fewer.region_metrics.pop_back();
  EXPECT_FALSE(FaceSpace::have_matching_sizes(fewer, heads));
  FaceSpaceTables narrower = space.tables();
  narrower.principal_directions = narrower.principal_directions.leftCols(3).eval();
  EXPECT_FALSE(FaceSpace::have_matching_sizes(narrower, heads));
  EXPECT_FALSE(FaceSpace::have_matching_sizes(space.tables(), heads_at_samples(1, true)));
}

}  // namespace
}  // namespace crowdface
