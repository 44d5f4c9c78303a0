// SPDX-License-Identifier: Apache-2.0
// Where commands write, and what they never write over.
#include <gtest/gtest.h>

#include "crowdface/job/generate.h"

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
            {"input of this job"});
  fs::create_symlink("heads/ann.obj", folder_ / "latest.obj");
  crowdface(64, {"blend", config, "--recipe", recipe, "--cache", cache, "-o", at("latest.obj")},
            {"input of this job"});
  fs::remove(folder_ / "latest.obj");
  crowdface(73, {"check", config, "--log-file", folder_.head("ann").string()}, {"log"});
  expect_nothing_changed();
  // A region's picture would get the name of its mask.
  const std::string region = folder_.crowd().region_names()[0];
  folder_.folder().write("masks/" + region + ".png", read_text(folder_ / "mask_0.png"));
  crowdface(64,
            {"check", config, "--masks", at("masks"), "--set",
             "regions.mask=" + at("masks/" + region + ".png")},
            {"input of this job"});
  EXPECT_EQ(read_text(folder_ / ("masks/" + region + ".png")), read_text(folder_ / "mask_0.png"));
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
  for (const char* name : {"h\xe4ut", "two\nlines"}) {
    fs::create_directory(folder_ / name);
    fs::copy(folder_ / "heads", folder_ / name, fs::copy_options::recursive);
    before_ = all();
    crowdface(64, {"plan", folder_.config().string(), "--out", at(name)}, {"expected"});
    crowdface(64, {"init", at(name), "-o", at("new.yaml")}, {"UTF-8"});
    expect_nothing_changed();
  }
}

TEST_F(Outputs, NamesInCommentsOfAConfigStayThere) {
  fs::copy(folder_.head("ann"), folder_ / "heads/a\nregions: {}.obj");
  crowdface(0, {"init", at("heads"), "-o", at("new.yaml")});
  EXPECT_EQ(read_text(folder_ / "new.yaml").find("\nregions: {}"), std::string::npos);
}

}  // namespace
}  // namespace crowdface::testing
