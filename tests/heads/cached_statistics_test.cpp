// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cached_statistics.h"

#include <filesystem>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "crowdface/heads/cache_folder.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMeshVertices = 30, kTexturedHeads = 3;

class KeptStatistics : public ::testing::Test {
 protected:
  SurfaceStatistics kept(const Digest& key = {1, 2}, std::size_t heads = kTexturedHeads) {
    return cached_statistics(folder_.path(), key, kMeshVertices, heads, [&] {
      ++made_;
      std::mt19937 random(5);
      SurfaceStatistics statistics;
      for (std::size_t h = 0; h < heads; ++h) {
        statistics.coarse_values.emplace_back(SurfaceStatistics::Colours(kMeshVertices, 3));
        for (float& value : statistics.coarse_values.back().reshaped()) {
          value = static_cast<float>(random() % 1000);
        }
      }
      statistics.pair_count = heads * (heads + 1) / 2;
      for (std::size_t i = 0; i < kMeshVertices * statistics.pair_count; ++i) {
        statistics.covariances.push_back(static_cast<float>(random() % 1000));
      }
      if (broken_) statistics.covariances[7] = std::numeric_limits<float>::infinity();
      return statistics;
    });
  }
  static bool alike(const SurfaceStatistics& a, const SurfaceStatistics& b) {
    return a.coarse_values == b.coarse_values && a.covariances == b.covariances &&
           a.pair_count == b.pair_count;
  }

  testing::TemporaryFolder folder_;
  int made_ = 0;
  bool broken_ = false;
};

TEST_F(KeptStatistics, AreMadeOnceForAKey) {
  const SurfaceStatistics first = kept();
  EXPECT_TRUE(alike(kept(), first));
  EXPECT_EQ(made_, 1);
  EXPECT_GT(first.covariance(4, 2, 1), 0);
  kept({1, 3});
  EXPECT_EQ(made_, 2);
}

TEST_F(KeptStatistics, AreMadeAnewWhereAnEntryIsDamagedOrOfOtherHeads) {
  const SurfaceStatistics first = kept();
  const fs::path entry = list_cache(folder_.path()).entries.at(0);
  fs::resize_file(entry, fs::file_size(entry) - 1);
  EXPECT_TRUE(alike(kept(), first));
  EXPECT_EQ(made_, 2);
  EXPECT_EQ(kept({1, 2}, kTexturedHeads + 1).coarse_values.size(), kTexturedHeads + 1);
  EXPECT_EQ(made_, 3);
}

TEST_F(KeptStatistics, OfNumbersThatAreNoneAreNotTakenFromTheCache) {
  broken_ = true;
  kept();
  broken_ = false;
  const SurfaceStatistics sound = kept();
  EXPECT_EQ(made_, 2);
  EXPECT_TRUE(alike(kept(), sound));
  EXPECT_EQ(made_, 2);
}

TEST(StatisticsKey, IsAnotherOfWhateverChangesThem) {
  const auto map_of = [](Density first) {
    TextureMap map{2, 1, {first, 2, 3, 4, 5, 6}};
    return std::make_shared<const TextureMap>(std::move(map));
  };
  Topology topology;
  topology.vertex_count = 3;
  topology.corner_vertices = {0, 1, 2};
  topology.face_offsets = {0, 3};
  topology.corner_uvs = {0, 1, 2};
  TextureCoordinates uvs = TextureCoordinates::Zero(3, 2);
  CrowdTextures textures{{{{2, 1}}, {0}, {{0, 0}}}, {{map_of(1), map_of(2)}}};
  StatisticsScale scale;
  Digest rows{3, 4};
  std::set<std::string> keys;
  const auto is_new = [&] {
    return keys.insert(statistics_key(rows, topology, uvs, textures, scale).hex()).second;
  };
  EXPECT_TRUE(is_new());
  EXPECT_FALSE(is_new());
  textures.maps[0][1] = map_of(3);
  EXPECT_TRUE(is_new()) << "a texel";
  textures.maps[0][1] = nullptr;
  EXPECT_TRUE(is_new()) << "a head without a map";
  std::swap(textures.maps[0][0], textures.maps[0][1]);
  EXPECT_TRUE(is_new()) << "another head without one";
  uvs(1, 0) = 0.5;
  EXPECT_TRUE(is_new()) << "where a corner lies";
  topology.corner_uvs = {0, 2, 1};
  EXPECT_TRUE(is_new()) << "which corner lies there";
  textures.layout.picture_of_polygon = {kNoIndex};
  EXPECT_TRUE(is_new()) << "a face without a picture";
  scale.detail_iterations = 5;
  EXPECT_TRUE(is_new()) << "what counts as detail";
  scale.covariance_iterations = 17;
  EXPECT_TRUE(is_new()) << "over how much it is averaged";
  rows.low = 5;
  EXPECT_TRUE(is_new()) << "the mesh";
}

}  // namespace
}  // namespace crowdface
