// SPDX-License-Identifier: Apache-2.0
// Test 15 of docs/reliability.md: what surrounds a run does not show in its files.
#include <clocale>
#include <cstdlib>
#include <locale>

#include <sys/stat.h>
#include <unistd.h>

#include "crowdface/core/text.h"

#include "reliability/crowd_under_test.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

/// Numbers as no C program writes them: "1.234.567,5".
class StrangeNumbers : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

struct Surroundings {
  const char* name;
  void (*enter)();
};

void set_zone(const char* zone) {
  ::setenv("TZ", zone, 1);  // NOLINT(concurrency-mt-unsafe): before any thread
  ::tzset();
}

const std::vector<Surroundings>& all_surroundings() {
  static const std::vector<Surroundings> all = {
      {"ten years later", [] { shift_clock(315'576'000); }},
      {"before 1970", [] { shift_clock(-3'000'000'000); }},
      {"after 2038", [] { shift_clock(1'000'000'000); }},
      {"TZ Kiritimati", [] { set_zone("LINT-14"); }},
      {"TZ nonsense", [] { set_zone("nonsense/zone"); }},
      {"strange numbers",
       [] { std::locale::global(std::locale(std::locale::classic(), new StrangeNumbers)); }},
      {"LC_ALL de_DE",
       [] {
         ::setenv("LC_ALL", "de_DE.UTF-8", 1);  // NOLINT(concurrency-mt-unsafe)
         std::setlocale(LC_ALL, "");            // NOLINT(concurrency-mt-unsafe)
       }},
      {"umask 077", [] { ::umask(077); }},
      {"umask 0", [] { ::umask(0); }},
      {"working directory /", [] { fs::current_path("/"); }},
      {"working directory that is gone",
       [] {
         const TemporaryFolder gone;
         fs::current_path(gone.path());
       }},
      {"no HOME, no TMPDIR",
       [] {
         ::unsetenv("HOME");    // NOLINT(concurrency-mt-unsafe)
         ::unsetenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe)
       }},
  };
  return all;
}

class AnySurroundings : public DisturbedCrowd {};

TEST_F(AnySurroundings, GiveTheSameFiles) {
  EXPECT_GE(all_surroundings().size(), 12U);
  for (const Surroundings& surroundings : all_surroundings()) {
    fs::remove_all(folder_.out());
    fs::remove_all(folder_.cache());
    const ChildOutcome outcome = run_with_fault(folder_.out(), {}, [&] {
      surroundings.enter();
      generate_here();
    });
    EXPECT_EQ(outcome.code, 0) << surroundings.name << ": " << outcome.message;
    EXPECT_THAT(differences(), ::testing::IsEmpty()) << surroundings.name;
  }
}

TEST_F(AnySurroundings, TheClockIsReallyShifted) {
  const ChildOutcome outcome = run_with_fault(folder_.out(), {}, [&] {
    shift_clock(4'000'000'000);
    generate_here();
  });
  EXPECT_EQ(outcome.code, 0) << outcome.message;
  const std::string log = read_text(folder_.out() / "crowdface.log");
  EXPECT_TRUE(log.starts_with("215")) << log.substr(0, 40);
}

}  // namespace
}  // namespace crowdface::testing
