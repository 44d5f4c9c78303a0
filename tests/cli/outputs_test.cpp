// SPDX-License-Identifier: Apache-2.0
// Where commands write, and what they never write over.
#include <utility>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/run/generate.h"

#include "cli/program_test.h"
#include "support/crowd_files.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

class Outputs : public ::testing::Test {
 protected:
  Outputs() {
    generate(folder_.config(), {}, {folder_.cache(), Replace::kRefuse, false});
    before_ = all();
  }
  std::map<std::string, std::string> all() const { return crowd_files(folder_.folder().path()); }
  void expect_nothing_changed() const {
    EXPECT_THAT(differing_files(before_, all()), ::testing::IsEmpty());
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  SmallCrowdFolder folder_{[] {
    SmallCrowd crowd;
    crowd.regions = 2;
    crowd.count = 1;
    return crowd;
  }()};
  std::map<std::string, std::string> before_;
};

TEST_F(Outputs, InputsAreNotWrittenOver) {
  const std::string config = folder_.config().string(), cache = folder_.cache().string();
  const std::string recipe = at("out/plan.jsonl#mob_0001");
  crowdface(64, {"blend", config, "--recipe", recipe, "--cache", cache, "-o", at("heads/ann.obj")},
            {"is an input"});
  fs::create_symlink("heads/ann.obj", folder_ / "latest.obj");
  crowdface(64, {"blend", config, "--recipe", recipe, "--cache", cache, "-o", at("latest.obj")},
            {"is an input"});
  fs::remove(folder_ / "latest.obj");
  crowdface(73, {"check", config, "--log-file", folder_.head("ann").string()}, {"log"});
  expect_nothing_changed();
  // A region's picture would get the name of its mask.
  const std::string region = folder_.crowd().region_names()[0];
  folder_.folder().write("masks/" + region + ".png", read_text(folder_ / "mask_0.png"));
  crowdface(64,
            {"check", config, "--masks", at("masks"), "--set",
             "regions.mask=" + at("masks/" + region + ".png")},
            {"is an input"});
  EXPECT_EQ(read_text(folder_ / ("masks/" + region + ".png")), read_text(folder_ / "mask_0.png"));
}

// A mesh was written over a mask.
TEST_F(Outputs, AMeshIsNotWrittenUnderAPicturesName) {
  crowdface(
      64,
      {"wrap", folder_.head("ann").string(), folder_.head("bob").string(), "-o", at("mask_0.png")},
      {".obj"});
  expect_nothing_changed();
}

// A head became a config, a scan its own smoothing.
TEST_F(Outputs, NorAreThoseOfInitAndSmooth) {
  const std::string head = folder_.head("ann").string();
  crowdface(64, {"init", at("heads"), "-o", head, "--force"}, {"is an input"});
  crowdface(64, {"smooth", head, "--iterations", "3", "-o", head}, {"is an input"});
  fs::copy_file(head, folder_ / "ann_3.obj");
  before_ = all();
  crowdface(64, {"smooth", at("ann_3.obj"), "--iterations", "3,5", "-o", at("ann.obj")}, {"input"});
  expect_nothing_changed();
}

// Pictures of regions before the one that is refused were written.
TEST_F(Outputs, PicturesOfRegionsAreWrittenAllOrNone) {
  const std::string last = folder_.crowd().region_names().back();
  folder_.folder().write("masks/" + last + ".png", read_text(folder_ / "mask_0.png"));
  before_ = all();
  crowdface(64,
            {"check", folder_.config().string(), "--masks", at("masks"), "--set",
             "regions.mask=" + at("masks/" + last + ".png")},
            {"is an input"});
  expect_nothing_changed();
}

// The program died, or ended as done.
TEST_F(Outputs, ALogThatCannotBeWrittenIsAFailure) {
  const std::string log = at("full.log");
  folder_.folder().write("full.log", "2026-11-22T00:00:00.000+0000 info begins\n");
  fs::resize_file(log, 8 << 20);
  const auto limited = [](std::vector<std::string> arguments) {
    std::vector<std::string> shell = {"-c", "ulimit -f 8192; exec \"$0\" \"$@\"",
                                      CROWDFACE_PROGRAM};
    shell.insert(shell.end(), arguments.begin(), arguments.end());
    return run_program("/bin/bash", shell);
  };
  const Outcome made =
      limited({"synth", "-o", at("new"), "--count", "1", "--vertices", "5000", "--log-file", log});
  EXPECT_EQ(made.code, 74) << made.err;
  EXPECT_THAT(made.err, ::testing::HasSubstr("full.log"));
  EXPECT_TRUE(fs::exists(folder_ / "new/synth_01.obj")) << "the work itself was done";
  EXPECT_EQ(limited({"check", at("none.yaml"), "--log-file", log}).code, 66);
  // The same with the log in a crowd's folder.
  fs::rename(log, folder_ / "out/crowdface.log");
  const std::vector<std::string> again = {"generate", folder_.config().string(), "--cache",
                                          folder_.cache().string()};
  EXPECT_EQ(limited(again).code, 74);
  fs::remove(folder_ / "out/crowdface.log");
  EXPECT_EQ(limited(again).code, 0);
}

TEST_F(Outputs, OtherFilesAreNoLogs) {
  folder_.folder().write("data.csv", "1,2,3\n");
  crowdface(73, {"check", folder_.config().string(), "--log-file", at("data.csv")}, {"data.csv"});
  crowdface(73, {"check", folder_.config().string(), "--log-file", at("no/x.log")}, {"no/x.log"});
  EXPECT_EQ(read_text(folder_ / "data.csv"), "1,2,3\n");
  EXPECT_FALSE(fs::exists(folder_ / "no"));
}

// A file that was opened got the number of a closed stream, and what was said to it.
TEST_F(Outputs, ClosedStreamsAndPipesHarmNoFile) {
  const std::string run =
      concat("\"$0\" generate ", folder_.config().string(), " --cache ", folder_.cache().string());
  const auto shell = [&](const std::string& script) {
    return run_program("/bin/bash", {"-c", script, CROWDFACE_PROGRAM}).code;
  };
  fs::remove(folder_ / "out/meshes/mob_0001.obj");
  EXPECT_EQ(shell(run + " <&- >&- 2>&-"), 0);
  EXPECT_EQ(shell(run + " 2>&1 | true; exit ${PIPESTATUS[0]}"), 0);
  EXPECT_EQ(shell("(sleep 0.3; exec \"$0\" --help) | true; exit ${PIPESTATUS[0]}"), 74);
  std::map<std::string, std::string> now = all();
  for (auto* files : {&before_, &now}) {
    std::erase_if(*files, [](const auto& file) {
      return file.first.ends_with("timings.json") || file.first.ends_with("crowdface.log");
    });
  }
  EXPECT_THAT(differing_files(before_, now), ::testing::IsEmpty());
}

TEST_F(Outputs, NohupIsHeeded) {
  const std::string script = concat(
      "trap '' HUP; \"$0\" generate ", folder_.config().string(), " --count 300 --cache ",
      folder_.cache().string(), " --out ", at("long"), " -q & run=$!; until [ -e ",
      at("long/crowdface.log"), " ]; do sleep 0.02; done; kill -HUP $run || exit 9; wait $run");
  EXPECT_EQ(run_program("/bin/bash", {"-c", script, CROWDFACE_PROGRAM}).code, 0);
}

TEST_F(Outputs, AConfigBesideItsCrowdIsNotReplaced) {
  folder_.folder().write("config.yaml", "# mine\n" + read_text(folder_.config()));
  before_ = all();
  for (const char* option : {"--force", "--dry-run", "-q"}) {
    crowdface(64, {"plan", folder_.config().string(), "--out", at(""), option}, {"own config"});
  }
  expect_nothing_changed();
}

TEST_F(Outputs, WhatCannotBeWrittenIsToldBeforeTheWork) {
  const std::string config = folder_.config().string(), nowhere = at("nowhere/x.obj");
  const std::string cache = at("fresh_cache");
  crowdface(
      73,
      {"blend", config, "--recipe", at("out/plan.jsonl#mob_0001"), "--cache", cache, "-o", nowhere},
      {"nowhere"});
  crowdface(73, {"smooth", folder_.head("ann").string(), "--iterations", "3", "-o", nowhere});
  crowdface(64, {"smooth", folder_.head("ann").string(), "--iterations", "3", "-o", at("x.glb")},
            {".obj"});
  crowdface(73, {"synth", "-o", at("synth"), "--count", "1", "--mask", at("nowhere/m.png")});
  crowdface(73, {"plan", config, "--estimate", "--cache", cache, "--out", at("config.yaml/x")});
  crowdface(73, {"plan", config, "--dry-run", "--cache", cache, "--out", at("config.yaml/x")});
  crowdface(64, {"plan", config, "--estimate", "--dry-run"}, {"--dry-run"});
  crowdface(73, {"prepare", config, "--cache", config});
  crowdface(66, {"cache", "--cache", config}, {"folder"});
  crowdface(66, {"import", "makehuman", "--data", at("nowhere"), "-o", at("imported")});
  EXPECT_FALSE(fs::exists(folder_ / "imported"));
  expect_nothing_changed();
}

// The config in the crowd's folder could not be read again, nor the crowd gathered.
TEST_F(Outputs, PathsThatNoConfigCanHoldAreRefused) {
  for (const auto& [name, why] :
       {std::pair{"h\xe4ut", "UTF-8"}, std::pair{"two\nlines", "a single line"}}) {
    fs::create_directory(folder_ / name);
    fs::copy(folder_ / "heads", folder_ / name, fs::copy_options::recursive);
    before_ = all();
    crowdface(64, {"plan", folder_.config().string(), "--out", at(name)}, {"expected"});
    crowdface(64, {"init", at(name), "-o", at("new.yaml")}, {why});
    expect_nothing_changed();
  }
}

TEST_F(Outputs, FileNamesThatNoConfigTakesWriteNone) {
  fs::copy(folder_.head("ann"), folder_ / "heads/a\nregions: {}.obj");
  crowdface(64, {"init", at("heads"), "-o", at("new.yaml")},
            {"a\\x0aregions: {}", "without control characters"});
  EXPECT_FALSE(fs::exists(folder_ / "new.yaml"));
}

}  // namespace
}  // namespace crowdface::testing
