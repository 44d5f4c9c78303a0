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
  Outcome run(const std::string& fail_at, const std::string& more = "FAULT=") const {
    fs::remove_all(folder_.out());
    return run_program("/usr/bin/env",
                       {concat("LD_PRELOAD=", CROWDFACE_LIBRARY_FAULTS), "FAULT_CALL=" + GetParam(),
                        "FAULT_AT=" + fail_at, "FAULT_COUNT=" + count_file().string(), more,
                        CROWDFACE_PROGRAM, "generate", "-q", folder_.config().string(), "--cache",
                        folder_.cache().string(), "--threads", "2"});
  }
  /// Lets the call of some numbers fail, and expects a message or a whole crowd.
  void expect_told(int tries_in_suite, int tries_in_soak, const std::string& more);
  static constexpr const char* kNever = "18446744073709551615";
  fs::path count_file() const { return folder_ / "count"; }

  SmallCrowdFolder folder_;
};

void LibraryCall::expect_told(int tries_in_suite, int tries_in_soak, const std::string& more) {
  run(kNever);  // the cache is there from now on
  ASSERT_EQ(run(kNever).code, 0);
  const auto whole = crowd_files(folder_.out());
  const auto calls =
      parse_unsigned(read_text(count_file()).substr(0, read_text(count_file()).find('\n')));
  ASSERT_TRUE(calls.has_value());
  ASSERT_GT(*calls, 0U) << "no such call is made";
  RecordProperty("calls", static_cast<int>(*calls));
  const auto tries =
      std::min(*calls, static_cast<std::uint64_t>(times(tries_in_suite, tries_in_soak)));
  for (std::uint64_t i = 0; i < tries; ++i) {
    const std::uint64_t at = (2 * i + 1) * *calls / (2 * tries);
    const Outcome outcome = run(concat(at), more);
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

// Sheets lacked letters, or the ledger its sheets, and the exit code was 0.
TEST_P(LibraryCall, ThatFailsIsToldOrDoesNoHarm) {
  expect_told(4, 200, "FAULT=");
}

TEST_P(LibraryCall, ThatFailsFromThenOnIsTold) {
  expect_told(3, 50, "FAULT_FOREVER=1");
}

// A limit on processes (RLIMIT_NPROC) lets no thread start, the next one no more than the first.
TEST(NoThreads, EndEveryCommandThatNeedsThem) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder / name).string(); };
  const auto run = [&](std::vector<std::string> arguments, bool threads) {
    arguments.insert(arguments.begin(), {CROWDFACE_PROGRAM});
    if (!threads) {
      arguments.insert(arguments.begin(),
                       {concat("LD_PRELOAD=", CROWDFACE_LIBRARY_FAULTS),
                        "FAULT_CALL=pthread_create", "FAULT_AT=0", "FAULT_FOREVER=1"});
    }
    return run_program("/usr/bin/env", arguments);
  };
  const std::vector<std::string> synth = {"synth",      "-q",   "-o",      at("heads"),
                                          "--vertices", "5000", "--count", "3"};
  const std::vector<std::string> init = {"init", "-q", at("heads"), "-o", at("crowd.yaml")};
  const std::string cache = at("cache"), config = at("crowd.yaml");
  ASSERT_EQ(run(synth, true).code, 0);
  ASSERT_EQ(run(init, true).code, 0);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"generate", config, "--cache", cache, "--count", "2"},
        {"check", config, "--cache", cache},
        {"prepare", config, "--cache", cache},
        {"plan", config, "--cache", cache},
        {"mask", at("heads"), "-o", at("mask.png")},
        {"wrap", at("heads/synth_01.obj"), at("heads/synth_02.obj"), "-o", at("wrapped.obj")},
        {"synth", "-o", at("more"), "--vertices", "5000", "--count", "3"}}) {
    const Outcome outcome = run(command, false);
    EXPECT_EQ(outcome.code, 74) << command.front() << ": " << outcome.err;
    EXPECT_THAT(outcome.err, ::testing::HasSubstr("threads")) << command.front();
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LibraryCall,
                         ::testing::Values("malloc", "calloc", "realloc", "posix_memalign",
                                           "aligned_alloc", "mmap", "opendir", "readdir", "fstat",
                                           "stat", "lstat", "pthread_create"),
                         [](const auto& kind) { return kind.param; });

}  // namespace
}  // namespace crowdface::testing
