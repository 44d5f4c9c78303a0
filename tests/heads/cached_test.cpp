// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cached.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/file.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/find_levels.h"
#include "crowdface/heads/shared_by_heads.h"

#include "support/forged_entry.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

struct Lists {
  std::vector<std::uint32_t> numbers;
  std::vector<double> values;
  bool operator==(const Lists&) const = default;
};

class Cached : public ::testing::Test {
 protected:
  /// A square that is large enough for its neighbours and its mirror to be cached, of kSide²
  /// vertices.
  static constexpr std::uint32_t kSide = 225;
  static Topology large_topology() { return testing::grid_topology(kSide - 1, kSide - 1); }
  static Positions large_positions() {
    Positions positions(kSide * kSide, 3);
    for (std::uint32_t row = 0; row < kSide; ++row) {
      for (std::uint32_t column = 0; column < kSide; ++column) {
        positions.row(row * kSide + column) << column - 0.5 * (kSide - 1), row, 0;
      }
    }
    return positions;
  }

  Lists lists(const Digest& key, std::uint32_t most = 9) {
    return read_or_make(
        folder_.path(), {"test", key},
        [&] {
          ++made_;
          return Lists{{1, 2, 3}, {0.5}};
        },
        [](auto& arrays, auto& kept) {
          arrays("numbers", kept.numbers);
          arrays("values", kept.values);
        },
        [&](const Lists& found, const CacheEntry&) {
          return found.numbers.size() == 3 && found.numbers[2] <= most;
        });
  }
  fs::path entry() const { return list_cache(folder_.path()).entries.at(0); }

  testing::TemporaryFolder folder_;
  int made_ = 0;
};

TEST_F(Cached, IsMadeOnceForAKey) {
  const Digest key{1, 2}, other{1, 3};
  const Lists first = lists(key);
  EXPECT_EQ(lists(key), first);
  EXPECT_EQ(made_, 1);
  EXPECT_EQ(lists(other), first);
  EXPECT_EQ(made_, 2);
}

TEST_F(Cached, IsMadeAnewWhereAnEntryIsCutOrChangedOrOfAnotherKey) {
  const Digest key{1, 2};
  const Lists first = lists(key);
  fs::resize_file(entry(), fs::file_size(entry()) - 1);
  EXPECT_EQ(lists(key), first);
  EXPECT_EQ(made_, 2);

  std::fstream(entry(), std::ios::in | std::ios::out | std::ios::binary).seekp(66).put('x');
  EXPECT_EQ(lists(key), first);
  EXPECT_EQ(made_, 3);

  const Digest other{7, 7};
  fs::copy_file(entry(), cache_entry(folder_.path(), {"test", other}));
  EXPECT_EQ(lists(other), first);
  EXPECT_EQ(made_, 4);
  EXPECT_EQ(lists(other), first);
  EXPECT_EQ(made_, 4);
}

TEST_F(Cached, IsMadeAnewWhereItIsNotSound) {
  const Digest key{1, 2};
  lists(key);
  EXPECT_EQ(lists(key, 2), (Lists{{1, 2, 3}, {0.5}}));
  EXPECT_EQ(made_, 2);
}

TEST_F(Cached, EntryTellsArraysByNameAndType) {
  const CacheKey key{"test", {1, 2}};
  const std::vector<std::array<double, 2>> pairs = {{1, 2}, {3, 4}};
  const Eigen::MatrixXd by_columns = Eigen::MatrixXd::Random(3, 5);
  const Positions by_rows = Positions::Random(4, 3);
  const std::vector<bool> marks = {true, false, true};
  const std::int16_t one = -7;
  ArrayWriter writer;
  writer("pairs", pairs);
  writer("by columns", by_columns);
  writer("by rows", by_rows);
  writer("one", one);
  writer("marks", marks);
  write_entry(folder_.path(), key, writer.arrays);
  const auto entry = CacheEntry::open(folder_.path(), key);
  ASSERT_TRUE(entry);
  const ArrayReader reader(*entry);
  const auto expect_same = [&](const char* name, const auto& written) {
    std::remove_cvref_t<decltype(written)> found;
    reader(name, found);
    EXPECT_EQ(found, written) << name;
  };
  expect_same("pairs", pairs);
  expect_same("by columns", by_columns);
  expect_same("by rows", by_rows);
  expect_same("one", one);
  expect_same("marks", marks);
  for (const char* name : {"pairs", "by columns", "by rows", "one"}) {
    EXPECT_EQ(testing::place_of_array(read_file(this->entry()), name) % 64, 0U);
  }
  EXPECT_THROW(entry->get<double>("one"), InvalidInput);
  EXPECT_THROW(entry->get<std::uint16_t>("one"), InvalidInput);
  EXPECT_THROW(entry->get<double>("pairs"), InvalidInput);
  EXPECT_THROW(entry->get<double>("none"), InvalidInput);
  std::array<double, 2> pair;
  EXPECT_THROW(reader("pairs", pair), InvalidInput) << "there are two";
  EXPECT_THROW(entry->matrix<TextureCoordinates>("by rows"), InvalidInput);
}

// Any number in the header may be forged under a right checksum.
TEST_F(Cached, NoForgedHeaderIsFollowedOutOfTheFile) {
  const Digest key{1, 2};
  const Lists first = lists(key);
  const std::string sound = read_file(entry());
  const std::size_t end = 32 + 2 * std::size_t{48};
  for (std::size_t at = 0; at + 8 <= end; at += 4) {
    for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{7}, ~std::uint64_t{0},
                                       std::uint64_t{1} << 63U, std::uint64_t{1} << 32U}) {
      write_file(entry(), testing::forged_at(sound, at, number));
      EXPECT_EQ(lists(key), first) << at << ' ' << number;
    }
  }
  EXPECT_GT(made_, 80);
}

// Rows were made for as many vertices as a component said to have.
TEST_F(Cached, ComponentsOfOtherSizesThanTheyHaveAreNotTaken) {
  Inputs inputs;
  inputs.head_set.topology = large_topology();
  inputs.cache = folder_.path();
  find_neighbours(inputs);
  const std::vector<std::uint32_t> sizes = {kSide * kSide};
  ASSERT_EQ(inputs.components.sizes, sizes);
  const std::string kept = read_file(entry());
  write_file(entry(), testing::forged_array(kept, "sizes", 0, std::uint32_t{1'000'000'000}));
  find_neighbours(inputs);
  EXPECT_EQ(inputs.components.sizes, sizes);
  EXPECT_EQ(read_file(entry()), kept);
}

TEST_F(Cached, PlacesOnTheOtherSideLieInTheirTriangles) {
  Inputs inputs;
  inputs.head_set.topology = large_topology();
  inputs.mean_head = large_positions();
  find_neighbours(inputs);
  inputs.cache = folder_.path();
  const Eigen::Vector3d side(1, 0, 0);
  const FoundMirror found = find_cached_mirror(inputs, side);
  const std::string kept = read_file(entry());
  for (const double share : {std::nan(""), 1e300}) {
    write_file(entry(), testing::forged_array(kept, "shares", 0, share));
    EXPECT_EQ(find_cached_mirror(inputs, side).map.barycentric, found.map.barycentric);
    EXPECT_EQ(read_file(entry()), kept);
  }
}

TEST_F(Cached, LevelsOfDetailAreThoseOfTheMesh) {
  Inputs inputs;
  inputs.head_set.topology = testing::cube_topology();
  inputs.head_set.heads = {{"cube", testing::cube_positions()}};
  inputs.mean_head = testing::cube_positions();
  inputs.materials.material_of_polygon.assign(
      static_cast<std::size_t>(inputs.head_set.topology.face_count()), 0);
  find_neighbours(inputs);
  Config config;
  config.output.lods = {50};
  config.output.meshes = {MeshFormat::kObj};
  const auto level = [&] {
    inputs.detail_levels.clear();
    find_levels(config, folder_.path(), inputs);
    return inputs.detail_levels.at(0);
  };
  const MeasuredLevel made = level();
  const std::string kept = read_file(entry());
  const auto expect_same = [&](const MeasuredLevel& found) {
    EXPECT_EQ(found.level.share, made.level.share);
    EXPECT_EQ(found.level.vertices, made.level.vertices);
    EXPECT_EQ(found.level.topology.corner_vertices, made.level.topology.corner_vertices);
    EXPECT_EQ(found.level.topology.face_offsets, made.level.topology.face_offsets);
    EXPECT_EQ(found.level.source_faces, made.level.source_faces);
    EXPECT_EQ(found.heads_error.max, made.heads_error.max);
    EXPECT_EQ(found.heads_error.root_mean_square, made.heads_error.root_mean_square);
  };
  expect_same(level());
  write_file(entry(), testing::forged_array(kept, "vertices", 0, std::uint32_t{8}));
  expect_same(level());
  EXPECT_EQ(read_file(entry()), kept);
  write_file(entry(), testing::forged_array(kept, "rms of shapes", 0, std::nan("")));
  expect_same(level());
  EXPECT_EQ(read_file(entry()), kept);
}

TEST_F(Cached, WithoutACacheNothingIsKept) {
  for (int times = 1; times <= 2; ++times) {
    read_or_make(
        fs::path(), {"test", Digest{}}, [&] { return ++made_; },
        [](auto& arrays, auto& number) { arrays("number", number); },
        [](int, const CacheEntry&) { return true; });
    EXPECT_EQ(made_, times);
  }
}

}  // namespace
}  // namespace crowdface
