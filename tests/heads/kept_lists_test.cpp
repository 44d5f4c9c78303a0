// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/kept_lists.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"

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
