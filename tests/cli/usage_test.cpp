// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/text.h"
#include "crowdface/core/version.h"

#include "cli/program_test.h"
#include "support/crowd_files.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

TEST(Usage, VersionAndHelpAreNoErrors) {
  EXPECT_EQ(crowdface(0, {"--version"}).out, std::string("crowdface ") + kVersion + "\n");
  crowdface(0, {"--help"},
            {"generate", "prepare", "plan", "blend", "smooth", "sheet", "synth", "check", "init",
             "cache", "75"});
  for (const auto& [command, phrases] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"generate",
            {"CONFIG", "--seed", "--count", "--out", "--set", "--force", "--dry-run", "--shard"}},
           {"prepare", {"CONFIG", "--cache"}},
           {"plan", {"CONFIG", "--dry-run"}},
           {"blend", {"--recipe", "PLAN.jsonl#ID", "--output"}},
           {"smooth", {"--iterations", "--boundary", "--operator", "--plain"}},
           {"sheet", {"CROWD_DIR"}},
           {"gather", {"CROWD_DIR", "--cache"}},
           {"verify", {"CROWD_DIR"}},
           {"submit", {"CONFIG", "--engine", "--shards", "--partition", "--scratch", "--print"}},
           {"status", {"CROWD_DIR", "--json", "--watch"}},
           {"synth", {"--vertices", "--seed", "--count"}},
           {"check", {"--masks"}},
           {"init", {"HEADS_DIR"}},
           {"mask", {"HEADS_DIR|CONFIG", "--bands"}},
           {"cache", {"--clear", "--cache"}}}) {
    const Outcome help = crowdface(0, {command, "--help"}, phrases);
    EXPECT_THAT(help.out, ::testing::AllOf(
                              ::testing::HasSubstr("--threads"), ::testing::HasSubstr("--quiet"),
                              ::testing::HasSubstr("--log-file"), ::testing::HasSubstr("--limit")));
  }
}

TEST(Usage, LibrariesOfImagesAreLoadedWithTheFirstThatIsNoPng) {
  const Outcome needed =
      run_program("/usr/bin/env", {"LD_TRACE_LOADED_OBJECTS=1", CROWDFACE_PROGRAM});
  EXPECT_THAT(needed.out, ::testing::HasSubstr("libtbb"));
  EXPECT_THAT(needed.out, ::testing::Not(::testing::HasSubstr("libOpenImageIO")));

  const TemporaryFolder folder;
  fs::create_directories(folder / "elsewhere");
  const fs::path alone = folder / "elsewhere/crowdface";
  fs::copy_file(CROWDFACE_PROGRAM, alone);
  EXPECT_EQ(run_program(alone.string(), {"--version"}).code, 0);
  const SmallCrowdFolder crowd(SmallCrowd{.regions = 2});
  const std::vector<std::string> check = {"check", "-q", crowd.config().string()};
  EXPECT_EQ(run_program(alone.string(), check).code, 0);  // its masks are PNGs

  using namespace std::string_literals;
  const fs::path mask = folder.write("mask.exr", "\x76\x2f\x31\x01\x02\0\0\0\0"s);
  const Outcome without = run_program(alone.string(), {"check", "-q", crowd.config().string(),
                                                       "--set", "regions.mask=" + mask.string()});
  EXPECT_EQ(without.code, 74) << without.err;
  EXPECT_THAT(without.err,
              ::testing::AllOf(::testing::HasSubstr("images can be neither read nor written"),
                               ::testing::HasSubstr("libcrowdface_images.so"),
                               ::testing::HasSubstr("is the installation complete?")));
}

TEST(Usage, WrongCommandLinesAre64) {
  crowdface(64, {});
  crowdface(64, {"generte", "x.yaml"}, {"generte", "did you mean generate?"});
  crowdface(64, {"x.yaml"}, {"x.yaml", "expected one of", "generate"});
  crowdface(64, {"generate", "x.yaml", "--colour"}, {"--colour"});
  crowdface(64, {"generate"}, {"config"});
}

// `--shard "$PART"` with PART unset ran everything, `synth -o ""` filled the folder it was called in.
TEST(Usage, EmptyValuesAre64) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const std::string config = folder.config().string();
  for (const char* option : {"--shard", "--out", "--cache", "--seed", "--count", "--set",
                             "--memory", "--log-file", "--threads", "--limit"}) {
    crowdface(64, {"generate", config, option, ""}, {option, "empty"});
  }
  crowdface(64, {"synth", "-o", ""}, {"empty"});
  crowdface(64, {"generate", ""}, {"config", "empty"});
  crowdface(64, {"verify", ""}, {"empty"});
  crowdface(64, {"check", "a\nerror: b.yaml"},
            {R"(expected a single line, found "a\x0aerror: b.yaml")"});
  EXPECT_FALSE(fs::exists(folder.out()));
}

// A texture's name could turn a terminal red, or write backwards.
TEST(Usage, NothingThatATerminalObeysIsPrinted) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const std::string odd = "\x1b[31m\xC2\x9B\xE2\x80\xAE";
  for (const Outcome& outcome :
       {crowdface(66, {"check", (folder / ("no" + odd + ".yaml")).string()}),
        crowdface(64, {"check", folder.config().string(), "--no" + odd}),
        crowdface(66, {"verify", (folder / odd).string()})}) {
    for (const char* part : {"\x1b", "\xC2\x9B", "\xE2\x80\xAE"}) {
      EXPECT_EQ((outcome.out + outcome.err).find(part), std::string::npos) << outcome.err;
    }
  }
}

TEST(Usage, WrongNumbersAre64AndChangeNothing) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const std::string config = folder.config().string();
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--threads", "0"},
                                                        {"--threads", "-1"},
                                                        {"--threads", "abc"},
                                                        {"--count", "2147483648"},
                                                        {"--count", "18446744073709551616"},
                                                        {"--seed", "-1"},
                                                        {"--set", "crowd.cuont=3"},
                                                        {"--shard", "0/2"},
                                                        {"--shard", "3/2"},
                                                        {"--shard", "2"},
                                                        {"--shard", "1/10000"},
                                                        {"--limit", "vertices=0"},
                                                        {"--limit", "noses=3"}}) {
    crowdface(64, {"generate", config, concat(option, "=", value)}, {option});
  }
  crowdface(64,
            {"smooth", folder.head("ann").string(), "--iterations=1e3", "-o",
             (folder / "x.obj").string()},
            {"--iterations", "1e3"});
  EXPECT_FALSE(fs::exists(folder.out()));
  EXPECT_FALSE(fs::exists(folder / "x.obj"));
}

}  // namespace
}  // namespace crowdface::testing
