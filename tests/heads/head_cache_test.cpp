// SPDX-License-Identifier: Apache-2.0
// Prepared heads: kept, used again, and never trusted when damaged.
#include <cstdlib>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "crowdface/heads/cache_folder.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::crowd_files;
using testing::differing_files;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

int from_cache(const SmallCrowdFolder& folder) {
  return testing::read_json(folder.out() / "timings.json").at("heads_from_cache").get<int>();
}

std::string log_of(const SmallCrowdFolder& folder) {
  return testing::read_text(folder.out() / "crowdface.log");
}

// NOLINTBEGIN(concurrency-mt-unsafe): no other thread runs in the one test that uses it
/// An environment variable for as long as it lives.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    ::setenv(name, value, 1);
  }
  ~Variable() {
    if (old_) {
      ::setenv(name_, old_->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};
// NOLINTEND(concurrency-mt-unsafe)

TEST(HeadCache, IsWhereTheEnvironmentSays) {
  const testing::TemporaryFolder folder;
  const Variable temporary("TMPDIR", folder.path().c_str());
  const Variable home("HOME", "/their/own");
  const Variable xdg("XDG_CACHE_HOME", "/caches");
  EXPECT_EQ(cache_directory(), "/caches/crowdface");
  const Variable no_xdg("XDG_CACHE_HOME", "");
  EXPECT_EQ(cache_directory(), "/their/own/.cache/crowdface");
  const Variable no_home("HOME", "");
  EXPECT_EQ(cache_directory(), folder / "crowdface-cache");
  // A folder that is gone ended the run as a bug of ours.
  const Variable gone("TMPDIR", (folder / "gone").c_str());
  EXPECT_EQ(cache_directory(), "/tmp/crowdface-cache");
}

/// Entries of prepared heads: beside them there is one of all heads' patches.
std::vector<fs::path> kept_heads(const SmallCrowdFolder& folder) {
  std::vector<fs::path> heads = list_cache(folder.cache()).entries;
  std::erase_if(heads, [](const fs::path& entry) {
    return !entry.filename().string().starts_with(kPreparedKind);
  });
  return heads;
}

TEST(HeadCache, SecondRunTakesAllHeadsFromIt) {
  for (const char* levels : {"basis", "exact", "cubic"}) {
    SmallCrowd crowd;
    crowd.levels = levels;
    const SmallCrowdFolder folder(crowd);
    run(folder);
    EXPECT_EQ(from_cache(folder), 0);
    EXPECT_EQ(kept_heads(folder).size(), 4U);
    const auto first = crowd_files(folder.out());
    run(folder);
    EXPECT_EQ(from_cache(folder), 4);
    EXPECT_THAT(differing_files(crowd_files(folder.out()), first), ::testing::IsEmpty());
  }
}

TEST(HeadCache, OtherSettingsAndOtherHeadsDoNotHit) {
  SmallCrowd crowd;
  SmallCrowdFolder folder(crowd);
  run(folder);
  for (const char* other : {"boundary", "operator", "limit"}) {
    SmallCrowd changed = crowd;
    if (other[0] == 'b') changed.boundary = "free";
    if (other[0] == 'o') changed.operator_kind = "lazy";
    if (other[0] == 'l') changed.smoothing_limit = "max_iterations: 61";
    folder.configure(changed);
    fs::remove_all(folder.out());
    run(folder);
    EXPECT_EQ(from_cache(folder), 0) << other;
  }
}

TEST(HeadCache, DamagedEntriesAreMadeAnewWithTheSameBytes) {
  SmallCrowd crowd;
  crowd.levels = "basis";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const auto first = crowd_files(folder.out());
  const fs::path entry = kept_heads(folder).at(1);
  const std::string whole = testing::read_text(entry);
  std::vector<std::string> damaged = {
      "",         "x", whole.substr(0, 47), whole.substr(0, 368), whole.substr(0, whole.size() - 1),
      whole + "x"};
  for (const std::size_t at :
       {std::size_t{0}, std::size_t{9}, std::size_t{20}, std::size_t{70}, std::size_t{73},
        std::size_t{90}, whole.size() / 2, whole.size() - 1}) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    damaged.push_back(flipped);
  }
  for (const std::string& bytes : damaged) {
    folder.folder().write("cache/" + entry.filename().string(), bytes);
    fs::remove(folder.out() / "crowdface.log");
    run(folder);
    EXPECT_EQ(from_cache(folder), 3) << bytes.size();
    EXPECT_THAT(log_of(folder), ::testing::HasSubstr(entry.filename().string())) << "warned";
    EXPECT_THAT(differing_files(crowd_files(folder.out()), first), ::testing::IsEmpty());
    EXPECT_EQ(testing::read_text(entry), whole) << "made anew";
  }
}

TEST(HeadCache, EntryOfAnotherHeadIsNotTaken) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder);
  const auto first = crowd_files(folder.out());
  const auto entries = kept_heads(folder);
  fs::copy_file(entries[0], entries[1], fs::copy_options::overwrite_existing);
  run(folder);
  EXPECT_EQ(from_cache(folder), 3);
  EXPECT_THAT(differing_files(crowd_files(folder.out()), first), ::testing::IsEmpty());
}

TEST(HeadCache, FolderThatCannotBeWrittenOnlyWarns) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder);
  const auto first = crowd_files(folder.out());
  folder.folder().write("taken", "a file in the place of the folder");
  for (const fs::path& cache : {folder / "taken", folder / "taken/below"}) {
    fs::remove_all(folder.out());
    generate(folder.config(), {}, {cache, Replace::kRefuse, false});
    EXPECT_THAT(differing_files(crowd_files(folder.out()), first), ::testing::IsEmpty());
    EXPECT_THAT(log_of(folder), ::testing::HasSubstr("cannot be stored in the cache"));
  }
  // A folder in the place of an entry.
  for (const fs::path& entry : list_cache(folder.cache()).entries) {
    fs::remove(entry);
    fs::create_directory(entry);
    fs::remove_all(folder.out());
    run(folder);
    EXPECT_THAT(differing_files(crowd_files(folder.out()), first), ::testing::IsEmpty());
  }
}

TEST(HeadCache, ItsHistoryChangesNoMesh) {
  SmallCrowd crowd;
  crowd.levels = "basis";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  ConfigOverrides other_order;
  other_order.assignments = {
      "faces={files: [heads/dan.obj, heads/bob.obj, heads/ann.obj, heads/cyd.obj], units: cm, "
      "align: none}"};
  const auto made = [&](const fs::path& cache) {
    generate(folder.config(), other_order, {cache, Replace::kForce, false});
    return crowd_files(folder.out());
  };
  const auto warm = made(folder.cache());
  EXPECT_EQ(from_cache(folder), 0) << "another head comes first, and a basis depends on it";
  fs::remove_all(folder.out());
  EXPECT_THAT(differing_files(warm, made(folder / "cold")), ::testing::IsEmpty());
}

TEST(HeadCache, LeftoversOfAKilledRunAreRemoved) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const fs::path leftover = folder.folder().write("cache/.crowdface-9999999-0.tmp", "half a head");
  run(folder);
  EXPECT_FALSE(fs::exists(leftover));
  folder.folder().write("cache/.crowdface-9999999-0.tmp", "half a head");
  const std::size_t entries = list_cache(folder.cache()).entries.size();
  EXPECT_EQ(clear_cache(folder.cache()), entries + 1);
  EXPECT_FALSE(fs::exists(leftover));
}

TEST(HeadCache, ClearRemovesEntriesAndNothingElse) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder);
  folder.folder().write("cache/notes.txt", "mine");
  folder.folder().write("cache/notes.cfcache", "mine");
  const CacheContents contents = list_cache(folder.cache());
  std::uintmax_t bytes = 0;
  for (const fs::path& entry : contents.entries) bytes += fs::file_size(entry);
  EXPECT_EQ(contents.bytes, bytes);
  EXPECT_EQ(clear_cache(folder.cache()), contents.entries.size());
  EXPECT_EQ(clear_cache(folder.cache()), 0U);
  EXPECT_TRUE(fs::exists(folder.cache() / "notes.txt"));
  EXPECT_TRUE(fs::exists(folder.cache() / "notes.cfcache"));
  EXPECT_EQ(list_cache(folder / "nowhere").entries.size(), 0U);
}

}  // namespace
}  // namespace crowdface
