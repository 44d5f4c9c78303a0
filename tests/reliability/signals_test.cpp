// SPDX-License-Identifier: Apache-2.0
// Test 23 of docs/reliability.md: a signal ends each command of the program.
#include <chrono>
#include <csignal>
#include <iostream>
#include <thread>

#include <sys/wait.h>

#include "crowdface/core/text.h"

#include "reliability/crowd_under_test.h"
#include "support/model_files.h"
#include "support/program.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using Files = std::map<std::string, std::string>;

/// Returns whether a child process ends within this time. The caller must still wait for it.
bool ends_within(pid_t child, Seconds time) {
  for (const auto start = Clock::now(); Clock::now() - start < time;) {
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT);
    if (info.si_pid == child) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/// The inputs of all commands, and a folder `out` that they write to.
class Signals : public ::testing::Test {
 protected:
  Signals() {
    std::signal(SIGINT, SIG_DFL);  // shells let their background jobs ignore it
    write_makehuman(folder_ / "package");
    const std::string size = concat(times(5'000, 50'000)), texels = concat(times(128, 512));
    prepare({"synth", "-o", at("heads"), "--count", "3", "--vertices", size, "--textures", texels,
             "--hair"});
    prepare({"init", at("heads"), "-o", at("crowd.yaml")});
    prepare({"generate", at("crowd.yaml"), "--cache", at("cache"), "--count", "2", "--out",
             at("made/crowd")});
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  void prepare(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run_program(CROWDFACE_PROGRAM, arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }

  /// Each command with a job that takes a while.
  std::vector<std::vector<std::string>> commands() const {
    const std::string config = at("crowd.yaml"), warm = at("cache"), cold = at("out/cache"),
                      head = at("heads/synth_01.obj"), other = at("heads/synth_02.obj"),
                      out = at("out/crowd");
    return {
        {"generate", config, "--cache", cold, "--count", "3", "--out", out, "--set",
         "output.meshes=[obj, glb, usd]"},
        {"check", config, "--cache", cold},
        {"convert", head, "-o", at("out/head.usda"), "--force"},
        {"init", at("heads"), "-o", at("out/crowd.yaml"), "--force"},
        {"mask", at("heads"), "--cache", cold, "-o", at("out/mask.png")},
        {"plan", config, "--cache", warm, "--count", "20", "--out", out, "--set",
         "diversity.min_distance=0mm", "--set", "diversity.min_distance_to_faces=0mm"},
        {"prepare", config, "--cache", cold},
        {"blend", config, "--recipe", at("made/crowd/plan.jsonl#crowd_0001"), "--cache", warm, "-o",
         at("out/face.obj")},
        {"smooth", head, "--iterations", "500,2500", "--plain", "-o", at("out/smooth.obj")},
        {"gather", out, "--cache", warm},
        {"verify", out},
        {"sheet", out, "--cache", warm},
        {"synth", "-o", at("out/heads"), "--count", "3", "--vertices", "5000", "--textures", "512"},
        {"import", "makehuman", "--data", at("package"), "-o", at("out/heads"), "--vertices",
         "20000"},
        {"cache", "--cache", warm},
        {"wrap", head, other, "-o", at("out/wrapped.obj")},
        {"edit", config, "--cache", warm, "--out", out, "--no-browser"},
        {"submit", config, "--cache", warm, "--out", out, "--print"},
        {"status", out},
        {"completion", "bash"},
        {"manual"}};
  }

  /// The folder `out` before a command: a crowd for the commands that work on one, else nothing.
  void reset(const std::string& command) const {
    fs::remove_all(at("out"));
    fs::create_directories(at("out"));
    if (std::set<std::string>{"gather", "verify", "sheet", "status"}.contains(command)) {
      fs::copy(at("made/crowd"), at("out/crowd"), fs::copy_options::recursive);
    }
  }
  /// What is in the folder `out` and may not differ between runs.
  Files files() const {
    Files found = crowd_files(at("out"));
    std::erase_if(found, [](const auto& file) {
      return file.first.ends_with("/timings.json") || file.first.ends_with("/crowdface.log");
    });
    return found;
  }

  /// Sends a signal after this time. Code -9: the program had not ended ten seconds later.
  Outcome run(const std::vector<std::string>& arguments, Seconds moment, int signal) {
    return run_program(CROWDFACE_PROGRAM, arguments, [&](pid_t child) {
      if (ends_within(child, moment)) return;
      const auto start = Clock::now();
      ::kill(child, signal);
      if (!ends_within(child, std::chrono::seconds(10))) ::kill(child, SIGKILL);
      longest_ = std::max<Seconds>(longest_, Clock::now() - start);
    });
  }

  /// Runs a command to its end. The editor does not end by itself: it serves its page for as long
  /// as it took to open, and then gets a signal.
  Outcome run_whole(const std::vector<std::string>& arguments) const {
    const std::string address = at("out/crowd/edited/.address");
    fs::remove(address);  // that of a killed editor
    return run_program(CROWDFACE_PROGRAM, arguments, [&](pid_t child) {
      if (arguments.front() != "edit") return;
      const auto start = Clock::now();
      while (!fs::exists(address)) {
        if (ends_within(child, std::chrono::milliseconds(10))) return;
      }
      if (!ends_within(child, Clock::now() - start)) ::kill(child, SIGTERM);
    });
  }

  TemporaryFolder folder_;
  Seconds longest_{};
};

TEST_F(Signals, EndEveryCommandAndTheNextRunGoesOn) {
  const std::string help = run_program(CROWDFACE_PROGRAM, {"--help"}).out;
  std::string tested;
  for (const auto& command : commands()) {
    const std::string& name = command.front();
    SCOPED_TRACE(name);
    reset(name);
    const Files before = files();
    const auto start = Clock::now();
    ASSERT_EQ(run_whole(command).code, 0);
    const Seconds whole_time = Clock::now() - start;
    const Files whole = files();
    longest_ = {};
    const int count = times(3, 20);
    for (int i = 0; i < count; ++i) {
      reset(name);
      const int signal = i % 2 == 0 ? SIGTERM : SIGINT;
      const Outcome outcome = run(command, whole_time * (i + 0.5) / count, signal);
      EXPECT_TRUE(outcome.code == 75 || outcome.code == 0 || outcome.code == -signal)
          << outcome.code << outcome.err;
      for (const auto& [file, bytes] : files()) {
        if (file.ends_with("ledger.jsonl") || file.ends_with("planned.json")) continue;
        // A run that ends in the middle of a block of work leaves its lock; the next run takes it.
        if (file.ends_with("/.crowdface.lock")) continue;
        const auto is_in = [](const Files& all, const std::string& path,
                              const std::string& content) {
          return all.contains(path) && all.at(path) == content;
        };
        EXPECT_TRUE(is_in(whole, file, bytes) || is_in(before, file, bytes))
            << file << " after " << outcome.code;
      }
      EXPECT_EQ(run_whole(command).code, 0);
      EXPECT_THAT(differing_files(whole, files()), ::testing::IsEmpty());
    }
    std::cout << concat(name, ": at most ", format_fixed(longest_.count(), 2), " s of ",
                        format_fixed(whole_time.count(), 1), " s")
              << std::endl;
    tested += concat("\n  ", name, " ");
  }
  for (const std::string_view line : split(help.substr(help.find("Subcommands:")), '\n')) {
    if (!line.starts_with("  ")) continue;
    const std::string name(line.substr(2, line.find(' ', 2) - 2));
    EXPECT_THAT(tested, ::testing::HasSubstr(concat("\n  ", name, " "))) << "is not tested";
  }
}

}  // namespace
}  // namespace crowdface::testing
