// SPDX-License-Identifier: Apache-2.0
// The configs that users start from: the examples in configs/ and what `crowdface init` writes.
#include <gmock/gmock.h>

#include "crowdface/job/starter_config.h"

#include "job/config_test_folder.h"

namespace crowdface {
namespace {

class ExampleConfigs : public ConfigTest {};

TEST_F(ExampleConfigs, AllAreReadWithStandIns) {
  for (int i = 1; i <= 8; ++i) {
    touch(concat("out/demo_heads/head_0", i, ".obj"));
    touch(concat("heads/ict/ict_0", i, ".obj"));
  }
  touch("heads/ict/ict_bands.1001.png");
  touch("masks/synth_bands.png");
  int examples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(CROWDFACE_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".yaml") continue;
    ++examples;
    const std::string name = entry.path().filename().string();
    const auto copy = touch("configs/" + name, read_file(entry.path()));
    problems_ = Problems();
    const auto config = read_config(copy, {}, problems_);
    ASSERT_TRUE(config) << told();
    EXPECT_EQ(config->output.directory, folder_ / "out" / entry.path().stem()) << name;
    EXPECT_EQ(config->crowd.name, entry.path().stem().string()) << name;
  }
  EXPECT_GE(examples, 6);
}

TEST_F(ExampleConfigs, TheStarterReadsBack) {
  StarterFacts facts;
  facts.heads = "heads";
  facts.names = {"ann", "bob", "cyd"};
  facts.units = LengthUnit::kInch;
  facts.head_height = 10.5;
  facts.up = {2, 1};
  facts.front = {1, -1};
  const std::string text = starter_config(facts);
  const auto config = read(text);
  ASSERT_TRUE(config) << told() << text;
  EXPECT_EQ(config->faces.names, facts.names);
  EXPECT_EQ(config->faces.units, LengthUnit::kInch);
  EXPECT_EQ(config->faces.up, facts.up);
  EXPECT_EQ(config->faces.front, facts.front);
  EXPECT_EQ(config->output.directory, folder_ / "out/crowd");
  EXPECT_THAT(text, testing::HasSubstr("10.50 units\n"));
  EXPECT_THAT(text, testing::HasSubstr("26.7 cm. PLEASE CHECK"));
}

TEST_F(ExampleConfigs, TheStarterTakesAnyFolderName) {
  StarterFacts facts;
  facts.names = {"ann", "bob"};
  for (const char* folder : {"a b", "#1", "x: y", "it's \"so\"", "ü", "yes", "-"}) {
    facts.heads = folder;
    touch(concat(folder, "/ann.obj"));
    touch(concat(folder, "/bob.obj"));
    EXPECT_TRUE(read(starter_config(facts))) << told();
  }
}

}  // namespace
}  // namespace crowdface
