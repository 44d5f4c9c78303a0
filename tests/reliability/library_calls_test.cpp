// SPDX-License-Identifier: Apache-2.0
// Calls that libraries make of the system, and for memory, fail one by one (library_faults.cpp).
#include <cstdlib>

#include "crowdface/core/text.h"

#include "reliability/crowd_under_test.h"
#include "support/program.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

class LibraryCall : public ::testing::TestWithParam<std::string> {
 protected:
  LibraryCall()
      : folder_([] {
          SmallCrowd crowd;
          crowd.count = 2;
          crowd.heads = 3;
          crowd.contact_sheet = "{columns: 2, rows: 2, cell: 48}";
          return crowd;
        }()) {}

  /// The program on the small crowd, anew, with the call of that number failing.
  Outcome run(const std::string& fail_at) const {
    fs::remove_all(folder_.out());
    return run_program("/usr/bin/env",
                       {concat("LD_PRELOAD=", CROWDFACE_LIBRARY_FAULTS), "FAULT_CALL=" + GetParam(),
                        "FAULT_AT=" + fail_at, "FAULT_COUNT=" + count_file().string(),
                        CROWDFACE_PROGRAM, "generate", "-q", folder_.config().string(), "--cache",
                        folder_.cache().string(), "--threads", "2"});
  }
  static constexpr const char* kNever = "18446744073709551615";
  fs::path count_file() const { return folder_ / "count"; }

  SmallCrowdFolder folder_;
};

// Sheets lacked letters, or the ledger its sheets, and the exit code was 0.
TEST_P(LibraryCall, ThatFailsIsToldOrDoesNoHarm) {
  run(kNever);  // the cache is there from now on
  ASSERT_EQ(run(kNever).code, 0);
  const auto whole = crowd_files(folder_.out());
  const auto calls =
      parse_unsigned(read_text(count_file()).substr(0, read_text(count_file()).find('\n')));
  ASSERT_TRUE(calls.has_value());
  ASSERT_GT(*calls, 0U) << "no such call is made";
  RecordProperty("calls", static_cast<int>(*calls));
  const auto tries = std::min(*calls, static_cast<std::uint64_t>(times(4, 200)));
  for (std::uint64_t i = 0; i < tries; ++i) {
    const std::uint64_t at = (2 * i + 1) * *calls / (2 * tries);
    const Outcome outcome = run(concat(at));
    const std::string what =
        concat(GetParam(), " number ", at, " of ", *calls, ": ", outcome.code, ' ', outcome.err);
    // The C library itself ends a program that it cannot register a thread's destructor for.
    if (outcome.err.find("failed to register TLS destructor: out of memory") != std::string::npos) {
      continue;
    }
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 73 || outcome.code == 74) << what;
    if (outcome.code == 0) {
      EXPECT_THAT(differing_files(whole, crowd_files(folder_.out())), ::testing::IsEmpty()) << what;
    } else {
      EXPECT_THAT(outcome.err, ::testing::HasSubstr("error:")) << what;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LibraryCall,
                         ::testing::Values("malloc", "calloc", "realloc", "posix_memalign",
                                           "aligned_alloc", "mmap", "opendir", "readdir", "fstat",
                                           "pthread_create"),
                         [](const auto& kind) { return kind.param; });

}  // namespace
}  // namespace crowdface::testing
