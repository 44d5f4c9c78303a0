// SPDX-License-Identifier: Apache-2.0
// Test 5 of docs/reliability.md: a damaged cache is made anew, and changes nothing.
#include <csignal>
#include <random>

#include <unistd.h>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cache_folder.h"

#include "reliability/crowd_under_test.h"
#include "support/forged_entry.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

class DamagedCache : public DisturbedCrowd {
 protected:
  DamagedCache()
      : DisturbedCrowd([] {
          SmallCrowd crowd;
          crowd.heads = 2;
          crowd.count = 1;
          crowd.levels = "basis";
          return crowd;
        }()) {
    for (const auto& entry : fs::directory_iterator(folder_.cache())) {
      entries_.push_back(entry.path());
    }
    std::sort(entries_.begin(), entries_.end());
    bytes_ = read_text(entries_[0]);
  }

  /// Runs several damages in one process. Each must be warned of, mended, and leave the same crowd.
  void expect_mended(const std::vector<std::string>& damaged) {
    const ChildOutcome outcome = run_with_fault(folder_.out(), {}, [&] {
      for (const std::string& bytes : damaged) {
        folder_.folder().write(entries_[0].lexically_relative(folder_.folder().path()).string(),
                               bytes);
        fs::remove_all(folder_.out());
        generate_here();
        if (!differences().empty()) throw std::runtime_error("other files");
        if (read_text(entries_[0]) != bytes_) throw std::runtime_error("not mended");
        const std::string log = read_text(folder_.out() / "crowdface.log");
        if (log.find("cache entry is") == log.npos || log.find("created again") == log.npos) {
          throw std::runtime_error("no warning");
        }
      }
    });
    EXPECT_EQ(outcome.code, 0) << outcome.message;
  }

  std::vector<fs::path> entries_;
  std::string bytes_;
};

TEST_F(DamagedCache, CutAnywhereIsMadeAnew) {
  ASSERT_EQ(entries_.size(), 4U) << "two heads, patches and a face space of both";
  std::vector<std::string> damaged;
  for (std::size_t size = 0; size < bytes_.size(); size += 4096) {
    damaged.push_back(bytes_.substr(0, size));
  }
  damaged.push_back(bytes_.substr(0, bytes_.size() - 1));
  damaged.push_back(bytes_ + '\0');
  expect_mended(damaged);
}

TEST_F(DamagedCache, AnyFlippedBitIsNoticed) {
  std::mt19937 random(4);
  std::vector<std::string> damaged;
  for (int i = 0; i < times(500, 10'000); ++i) {
    std::string bytes = bytes_;
    // Half of them in the header and the first numbers, where they tell the reader sizes.
    const std::size_t at = random() % (i % 2 == 0 ? 400 : bytes.size());
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
    damaged.push_back(std::move(bytes));
  }
  expect_mended(damaged);
}

/// Cuts every entry of the cache, or what else is named, when the signal comes.
std::vector<std::string> doomed;
void cut_them(int) {
  for (const std::string& file : doomed) {
    [[maybe_unused]] const int cut = ::truncate(file.c_str(), 4096);
  }
}

// The run died of SIGBUS, without a word.
TEST_F(DamagedCache, CutWhileItIsInUseItIsMadeAnewAndTheRunGoesOn) {
  doomed.clear();
  for (const fs::path& entry : list_cache(folder_.cache()).entries) {
    if (fs::file_size(entry) > 8192) doomed.push_back(entry.string());
  }
  ASSERT_FALSE(doomed.empty());
  std::map<std::string, std::string> entries;
  for (const std::string& file : doomed) entries[file] = read_text(file);
  int in_use = 0;
  for (std::uint64_t call = 0; call < undisturbed_.calls; call += 5) {
    fs::remove_all(folder_.out());
    for (const auto& [file, bytes] : entries) write_file(file, bytes);
    const ChildOutcome outcome =
        run_with_fault(folder_.out(), {Fault::Kind::kSignal, call, SIGUSR1}, [&] {
          std::signal(SIGUSR1, cut_them);
          watch_mapped_files();  // as the program does
          generate_here();
        });
    ASSERT_TRUE(outcome.struck);
    EXPECT_EQ(outcome.code, 0) << call << ": " << outcome.message;
    EXPECT_THAT(differences(), ::testing::IsEmpty()) << call;
    if (read_text(folder_.out() / "crowdface.log").find("truncated while it was in use") !=
        std::string::npos) {
      ++in_use;
    }
  }
  EXPECT_GT(in_use, 3);
}

// A checksum that is right is no proof that we wrote it: one such entry aborted in the ray tracer.
TEST_F(DamagedCache, NumbersThatNoHeadHasAreNotUsed) {
  struct Forged {
    const char* array;
    std::size_t at;
    float value;
  };
  constexpr Forged kForged[] = {{"mixing", 4, 1e30F},  // half of a number
                                {"first fields", 4, 1e30F},
                                {"steps", 0, 1e30F},
                                {"steps", 0, 0.3F}};
  for (const Forged& forge : kForged) {
    for (const fs::path& entry : list_cache(folder_.cache()).entries) {
      if (!entry.filename().string().starts_with(kPreparedKind)) continue;
      write_file(entry, forged_array(read_text(entry), forge.array, forge.at, forge.value));
    }
    fs::remove_all(folder_.out());
    EXPECT_EQ(run({}).code, 0);
    EXPECT_THAT(differences(), ::testing::IsEmpty());
    EXPECT_THAT(read_text(folder_.out() / "crowdface.log"),
                ::testing::HasSubstr("numbers out of range"));
  }
}

}  // namespace
}  // namespace crowdface::testing
