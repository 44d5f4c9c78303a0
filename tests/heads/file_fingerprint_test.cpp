// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/file_fingerprint.h"

#include <chrono>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "crowdface/heads/cache_folder.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// A file and a cache that trusts seen files.
class SeenFiles : public ::testing::Test {
 protected:
  SeenFiles() { cache_.skips_hash_of_unchanged_files = true; }

  void write(std::string_view text) const { folder_.write("head.obj", text); }
  static void let_settle() { std::this_thread::sleep_for(std::chrono::milliseconds(1100)); }
  std::optional<Digest> known() const { return FileFingerprint(cache_, file_).digest(); }
  void remember() const { FileFingerprint(cache_, file_).remember(kDigest); }

  static constexpr Digest kDigest = {1, 2};
  testing::TemporaryFolder folder_;
  fs::path file_ = folder_ / "head.obj";
  CacheFolder cache_ = folder_ / "cache";
};

TEST_F(SeenFiles, AreKnownUntilSomebodyWritesToThem) {
  write("v 0 0 0");
  const fs::file_time_type before = fs::last_write_time(file_);
  let_settle();
  EXPECT_FALSE(known().has_value());
  remember();
  EXPECT_EQ(known(), kDigest);
  write("v 1 1 1");
  fs::last_write_time(file_, before);  // of the same size, and the time of its bytes put back
  EXPECT_FALSE(known().has_value());
}

TEST_F(SeenFiles, AreNotKnownUnderTheNameOfOthers) {
  write("v 0 0 0");
  const fs::path other = folder_.write("other", "v 1 1 1");
  fs::last_write_time(other, fs::last_write_time(file_));
  let_settle();
  remember();
  fs::rename(other, file_);
  EXPECT_FALSE(known().has_value());
}

TEST_F(SeenFiles, AreNotKnownIfTheyChangedJustNowOrMeanwhile) {
  write("v 0 0 0");
  remember();
  EXPECT_FALSE(known().has_value());
  let_settle();
  const FileFingerprint seen(cache_, file_);
  write("v 1 1 1");
  let_settle();
  seen.remember(kDigest);
  EXPECT_FALSE(known().has_value());
}

TEST_F(SeenFiles, AreNotKnownWhereWhatWasSeenIsDamaged) {
  write("v 0 0 0");
  let_settle();
  remember();
  for (const fs::path& entry : list_cache(cache_).entries) {
    std::string bytes = testing::read_text(entry);
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(entry, std::ios::binary) << bytes;
  }
  EXPECT_FALSE(known().has_value());
}

TEST_F(SeenFiles, AreTrustedByNobodyWhoDoesNotAskForIt) {
  write("v 0 0 0");
  let_settle();
  remember();
  cache_.skips_hash_of_unchanged_files = false;
  EXPECT_FALSE(known().has_value());
  cache_.skips_hash_of_unchanged_files = true;
  EXPECT_EQ(known(), kDigest);
}

}  // namespace
}  // namespace crowdface
