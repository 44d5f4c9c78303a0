// SPDX-License-Identifier: Apache-2.0
// Test 15 of docs/reliability.md: what surrounds a run does not show in its files.
#include <cstdio>
#include <cstdlib>
#include <locale>
#include <stdexcept>

#include <sys/stat.h>
#include <unistd.h>

#include "crowdface/core/text.h"
#include "crowdface/heads/cache_folder.h"

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
      {"umask 077", [] { ::umask(077); }},
      {"umask 0", [] { ::umask(0); }},
      {"working directory /", [] { fs::current_path("/"); }},
      {"working directory that is gone",
       [] {
         const TemporaryFolder gone;
         fs::current_path(gone.path());
       }},
      {"no environment", [] { ::clearenv(); }},  // NOLINT(concurrency-mt-unsafe)
  };
  return all;
}

/// Writes "comma/LC_NUMERIC" below the folder: numbers as Germans write them. Needs localedef, which
/// every Debian has, and no other locale; it complains about all else that a locale defines.
void make_comma_locale(const TemporaryFolder& folder) {
  const fs::path source = folder.write("comma.txt",
                                       "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\n"
                                       "grouping 3;3\nEND LC_NUMERIC\n");
  const fs::path characters = folder.write("characters.txt",
                                           "<code_set_name> ASCII\n<escape_char> /\nCHARMAP\n"
                                           "<U002C> /x2c COMMA\n<U002E> /x2e FULL STOP\n"
                                           "END CHARMAP\n");
  const std::string command =
      concat("localedef -c -i '", source.string(), "' -f '", characters.string(), "' '",
             (folder / "comma").string(), "' >/dev/null 2>&1");
  // NOLINTNEXTLINE(concurrency-mt-unsafe)
  [[maybe_unused]] const int complains = std::system(command.c_str());
}

/// For C's functions and for streams. \throws unless it really is in force.
void enter_comma_locale(const fs::path& locales) {
  // NOLINTBEGIN(concurrency-mt-unsafe): before any thread
  ::unsetenv("LC_ALL");
  ::setenv("LC_NUMERIC", "comma", 1);
  ::setenv("LOCPATH", locales.c_str(), 1);
  // NOLINTEND(concurrency-mt-unsafe)
  std::locale::global(std::locale(std::locale::classic(), "comma", std::locale::numeric));
  char text[8];
  std::snprintf(text, sizeof text, "%.1f", 1.5);
  if (std::string_view(text) != "1,5") throw std::runtime_error(concat("1.5 is written ", text));
}

class AnySurroundings : public DisturbedCrowd {};

TEST_F(AnySurroundings, GiveTheSameFiles) {
  EXPECT_GE(all_surroundings().size(), 11U);
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

TEST_F(AnySurroundings, ALocaleWithCommasGivesTheSameFiles) {
  const TemporaryFolder locales;
  make_comma_locale(locales);
  ASSERT_TRUE(fs::exists(locales / "comma/LC_NUMERIC")) << "localedef of libc-bin made none";
  fs::remove_all(folder_.cache());
  const ChildOutcome outcome = run_with_fault(folder_.out(), {}, [&] {
    enter_comma_locale(locales.path());
    generate_here();
  });
  EXPECT_EQ(outcome.code, 0) << outcome.message;
  EXPECT_THAT(differences(), ::testing::IsEmpty());
}

struct CachePlace {
  const char* variable;
  const char* below;  ///< where the cache is in the folder that the variable names
};

TEST_F(AnySurroundings, WithoutHomeTheCacheIsWhereItIsPromised) {
  constexpr CachePlace kPlaces[] = {
      {"XDG_CACHE_HOME", "crowdface"}, {"HOME", ".cache/crowdface"}, {"TMPDIR", "crowdface-cache"}};
  for (const CachePlace& at : kPlaces) {
    const TemporaryFolder place;
    fs::remove_all(folder_.out());
    const ChildOutcome outcome = run_with_fault(folder_.out(), {}, [&] {
      // NOLINTBEGIN(concurrency-mt-unsafe): before any thread
      ::clearenv();
      ::setenv(at.variable, place.path().c_str(), 1);
      // NOLINTEND(concurrency-mt-unsafe)
      const ThreadLimit limit(2);
      generate(folder_.config(), {}, {cache_directory(), Replace::kRefuse, false});
    });
    EXPECT_EQ(outcome.code, 0) << at.variable << ": " << outcome.message;
    EXPECT_THAT(differences(), ::testing::IsEmpty()) << at.variable;
    EXPECT_TRUE(fs::is_directory(place / at.below) && !fs::is_empty(place / at.below))
        << at.variable;
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
