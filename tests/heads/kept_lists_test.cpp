// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/kept_lists.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/file.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/find_levels.h"
#include "crowdface/heads/shared_by_heads.h"

#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

using Lists = std::tuple<std::vector<std::uint32_t>, std::vector<double>>;

class KeptLists : public ::testing::Test {
 protected:
  Lists lists(const Digest& key, std::uint32_t most = 9) {
    return kept_lists<std::uint32_t, double>(
        folder_.path(), key,
        [&] {
          ++made_;
          return Lists{{1, 2, 3}, {0.5}};
        },
        [&](const auto& numbers, const auto& values) {
          return numbers.size() == 3 && numbers[2] <= most && values.size() == 1;
        });
  }
  fs::path entry() const { return list_cache(folder_.path()).entries.at(0); }

  testing::TemporaryFolder folder_;
  int made_ = 0;
};

TEST_F(KeptLists, AreMadeOnceForAKey) {
  const Digest key{1, 2}, other{1, 3};
  const Lists first = lists(key);
  EXPECT_EQ(lists(key), first);
  EXPECT_EQ(made_, 1);
  EXPECT_EQ(lists(other), first);
  EXPECT_EQ(made_, 2);
}

TEST_F(KeptLists, AreMadeAnewWhereAnEntryIsCutOrChangedOrOfAnotherKey) {
  const Digest key{1, 2};
  const Lists first = lists(key);
  fs::resize_file(entry(), fs::file_size(entry()) - 1);
  EXPECT_EQ(lists(key), first);
  EXPECT_EQ(made_, 2);

  std::fstream(entry(), std::ios::in | std::ios::out | std::ios::binary).seekp(66).put('x');
  EXPECT_EQ(lists(key), first);
  EXPECT_EQ(made_, 3);

  const Digest other{7, 7};
  fs::copy_file(entry(), cache_entry(folder_.path(), other, kListsEnding));
  EXPECT_EQ(lists(other), first);
  EXPECT_EQ(made_, 4);
  EXPECT_EQ(lists(other), first);
  EXPECT_EQ(made_, 4);
}

TEST_F(KeptLists, AreMadeAnewWhereTheyAreNotSound) {
  const Digest key{1, 2};
  lists(key);
  EXPECT_EQ(lists(key, 2), (Lists{{1, 2, 3}, {0.5}}));
  EXPECT_EQ(made_, 2);
}

/// Puts another number into an entry, under a right checksum.
template <class T>
void forge(const fs::path& entry, std::size_t at, T number) {
  std::string bytes = read_file(entry);
  std::memcpy(bytes.data() + at, &number, sizeof number);
  const Digest sum = hash_bytes(std::string_view(bytes).substr(0, bytes.size() - sizeof(Digest)));
  std::memcpy(bytes.data() + bytes.size() - sizeof sum, &sum, sizeof sum);
  write_file(entry, bytes);
}

// Rows were made for as many vertices as a component said to have.
TEST_F(KeptLists, ComponentsOfOtherSizesThanTheyHaveAreNotTaken) {
  Inputs inputs;
  inputs.faces.topology = testing::cube_topology();
  inputs.cache = folder_.path();
  find_neighbours(inputs);
  ASSERT_EQ(inputs.components.sizes, std::vector<std::uint32_t>{8});
  const std::string kept = read_file(entry());
  forge(entry(), kept.size() - sizeof(Digest) - 4, std::uint32_t{1'000'000'000});
  find_neighbours(inputs);
  EXPECT_EQ(inputs.components.sizes, std::vector<std::uint32_t>{8});
  EXPECT_EQ(read_file(entry()), kept);
}

TEST_F(KeptLists, PlacesOnTheOtherSideLieInTheirTriangles) {
  Inputs inputs;
  inputs.faces.topology = testing::cube_topology();
  inputs.mean = testing::cube_positions();
  find_neighbours(inputs);
  inputs.cache = folder_.path();
  const Eigen::Vector3d side(1, 0, 0);
  const FoundMirror found = find_other_sides(inputs, side);
  const std::string kept = read_file(entry());
  constexpr std::size_t kFirstShare = 48 + 6 * 8 + 8 * 12;  // after header, sizes and corners
  for (const double share : {std::nan(""), 1e300}) {
    forge(entry(), kFirstShare, share);
    EXPECT_EQ(find_other_sides(inputs, side).map.shares, found.map.shares);
    EXPECT_EQ(read_file(entry()), kept);
  }
}

TEST_F(KeptLists, LevelsOfDetailAreThoseOfTheMesh) {
  Inputs inputs;
  inputs.faces.topology = testing::cube_topology();
  inputs.faces.heads = {{"cube", testing::cube_positions()}};
  inputs.mean = testing::cube_positions();
  inputs.materials.of_face.assign(static_cast<std::size_t>(inputs.faces.topology.face_count()), 0);
  find_neighbours(inputs);
  Config config;
  config.output.lods = {50};
  config.output.meshes = {MeshFormat::kObj};
  const auto level = [&] {
    inputs.levels.clear();
    find_levels(config, folder_.path(), inputs);
    return inputs.levels.at(0);
  };
  const MeasuredLevel made = level();
  const std::string kept = read_file(entry());
  const auto expect_same = [&](const MeasuredLevel& found) {
    EXPECT_EQ(found.level.share, made.level.share);
    EXPECT_EQ(found.level.vertices, made.level.vertices);
    EXPECT_EQ(found.level.topology.corner_vertices, made.level.topology.corner_vertices);
    EXPECT_EQ(found.level.topology.face_offsets, made.level.topology.face_offsets);
    EXPECT_EQ(found.level.faces, made.level.faces);
    EXPECT_EQ(found.heads.most, made.heads.most);
    EXPECT_EQ(found.heads.root_mean_square, made.heads.root_mean_square);
  };
  expect_same(level());
  constexpr std::size_t kFirstVertex = 48 + 6 * 8;  // after header and sizes
  forge(entry(), kFirstVertex, std::uint32_t{8});
  expect_same(level());
  EXPECT_EQ(read_file(entry()), kept);
  forge(entry(), kept.size() - sizeof(Digest) - sizeof(double), std::nan(""));
  expect_same(level());
  EXPECT_EQ(read_file(entry()), kept);
}

TEST_F(KeptLists, WithoutACacheAreNotKept) {
  for (int times = 1; times <= 2; ++times) {
    const auto make = [&] {
      ++made_;
      return std::tuple(std::vector<double>{1});
    };
    kept_lists<double>({}, Digest{}, make, [](const auto&) { return true; });
    EXPECT_EQ(made_, times);
  }
}

}  // namespace
}  // namespace crowdface
