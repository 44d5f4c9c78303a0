// SPDX-License-Identifier: Apache-2.0
// Test 5 of docs/reliability.md: a damaged cache is made anew, and changes nothing.
#include <random>

#include "crowdface/core/text.h"

#include "reliability/crowd_under_test.h"

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
        if (log.find("cache entry is") == log.npos || log.find("made anew") == log.npos) {
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
  ASSERT_EQ(entries_.size(), 2U);
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

}  // namespace
}  // namespace crowdface::testing
