// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cached_patches.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>

#include <gtest/gtest.h>

#include "crowdface/heads/cache_folder.h"

#include "support/smooth_fields.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr Index kVertices = 20 * 21;

class KeptPatchesTest : public ::testing::Test {
 protected:
  KeptPatchesTest() {
    for (std::size_t h = 0; h < 8; ++h) {
      heads_.push_back(testing::smooth_levels(20, 21, h));
      ranks_.push_back(heads_.back().fields.rank);
    }
  }
  CachedPatches patches(const fs::path& cache, const Digest& key = {1, 2}) {
    return cached_patches(cache, key, kVertices, ranks_, [&] {
      ++made_;
      std::vector<std::uint32_t> order(kVertices);
      std::iota(order.begin(), order.end(), 0U);
      return interpolate_fields(heads_, std::vector<std::uint64_t>{1, 10, 100}, order, 0.1);
    });
  }
  static bool alike(const CachedPatches& a, const CachedPatches& b) {
    const PatchArrays &x = a.patches.arrays(), &y = b.patches.arrays();
    return std::ranges::equal(x.vertices, y.vertices) &&
           std::ranges::equal(x.stored_vertex_counts, y.stored_vertex_counts) &&
           std::ranges::equal(x.field_counts, y.field_counts) &&
           std::ranges::equal(x.quantization_steps, y.quantization_steps) &&
           std::ranges::equal(x.weights, y.weights) &&
           std::ranges::equal(x.quantized_values, y.quantized_values);
  }

  testing::TemporaryFolder folder_;
  std::vector<HeadSmoothing> heads_;
  std::vector<Index> ranks_;
  int made_ = 0;
};

TEST_F(KeptPatchesTest, AreMadeOnceForAKeyAndUsedFromTheFile) {
  const CachedPatches first = patches(folder_.path());
  EXPECT_TRUE(first.mapped_file) << "used from the file as soon as it is there";
  const CachedPatches again = patches(folder_.path());
  EXPECT_EQ(made_, 1);
  EXPECT_TRUE(alike(first, again));
  EXPECT_FALSE(first.patches.arrays().weights.empty());
  patches(folder_.path(), {1, 3});
  EXPECT_EQ(made_, 2);
}

TEST_F(KeptPatchesTest, AreMadeAnewWhereAnEntryIsDamagedOrOfOtherHeads) {
  const CachedPatches first = patches(folder_.path());
  const fs::path entry = list_cache(folder_.path()).entries.at(0);
  fs::resize_file(entry, fs::file_size(entry) - 20);
  EXPECT_TRUE(alike(patches(folder_.path()), first));
  EXPECT_EQ(made_, 2);
  std::swap(heads_[0], heads_[1]);
  heads_.push_back(testing::smooth_levels(20, 21, 8));
  ranks_.push_back(heads_.back().fields.rank);
  EXPECT_FALSE(alike(patches(folder_.path()), first)) << "lists of eight heads are none of nine";
  EXPECT_EQ(made_, 3);
}

TEST_F(KeptPatchesTest, StandInMemoryWhereTheyCannotBeKept) {
  const fs::path file = folder_.path() / "file";
  std::ofstream(file) << "no folder";
  const CachedPatches made = patches(file);
  EXPECT_FALSE(made.mapped_file);
  EXPECT_TRUE(alike(made, patches(folder_.path() / "cache")));
}

}  // namespace
}  // namespace crowdface
