// SPDX-License-Identifier: Apache-2.0
// The configs that users start from: the examples in configs/ and what `crowdface init` writes.
#include <gmock/gmock.h>

#include "crowdface/cast/diversity.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/core/text.h"

#include "config/config_test_folder.h"

namespace crowdface {
namespace {

class ExampleConfigs : public ConfigTest {};

TEST_F(ExampleConfigs, AllAreReadWithStandIns) {
  const auto synthetic = [](int i) {
    return concat("synth_", zero_padded(static_cast<std::uint64_t>(i), 2), ".obj");
  };
  for (int i = 1; i <= 24; ++i) touch("out/brief_heads/" + synthetic(i));
  for (int i = 1; i <= 16; ++i) touch("out/demo_heads/" + synthetic(i));
  for (int i = 1; i <= 8; ++i) {
    touch(concat("heads/ict/ict_0", i, ".obj"));
    touch(concat("heads/makehuman/makehuman_0", i, ".obj"));
  }
  for (const char* heads : {"out/brief_heads", "out/demo_heads"}) {
    touch(
        concat(heads, "/tags.yaml"),
        "faces: {tags: {synth_01: [female, old, light_skin], synth_02: [male, young, dark_skin],\n"
        "               synth_03: [female], synth_04: [male, old]}}");
    touch(concat(heads, "/attachments/attachments.yaml"), "attachments: {items: []}");
    for (const char* body : {"/body/body.obj", "/body/body.png"}) touch(concat(heads, body));
  }
  touch("heads/ict/ict_bands.1001.png");
  touch("heads/makehuman/makehuman_bands.png");
  touch("masks/synth_bands.png");
  int examples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(CROWDFACE_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".yaml") continue;
    ++examples;
    const std::string name = entry.path().filename().string();
    const std::string text = read_file(entry.path());
    const auto copy = touch("configs/" + name, text);
    problems_ = Problems();
    const auto config = read_config(copy, {}, problems_);
    ASSERT_TRUE(config) << told();
    EXPECT_EQ(config->output.directory, folder_ / "out" / entry.path().stem()) << name;
    EXPECT_EQ(config->crowd.name, entry.path().stem().string()) << name;
  }
  EXPECT_GE(examples, 6);
}

TEST_F(ExampleConfigs, ThoseOfThePapersFiguresAreRead) {
  for (int i = 1; i <= 8; ++i) {
    touch(concat("out/paper/synth/heads/head_", i, ".obj"));
    touch(concat("out/paper/table/heads/synth_0", i, ".obj"));
  }
  touch("masks/synth_bands.png");
  int figures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(CROWDFACE_SOURCE_DIR) / "configs/paper")) {
    const auto copy =
        touch("configs/paper/" + entry.path().filename().string(), read_file(entry.path()));
    problems_ = Problems();
    ASSERT_TRUE(read_config(copy, {}, problems_)) << entry.path() << told();
    ++figures;
  }
  EXPECT_EQ(figures, 13);
}

/// The YAML blocks of a page.
std::vector<std::string> yaml_blocks(const std::string& page) {
  const std::string open = "```yaml\n";
  std::vector<std::string> blocks;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    const std::size_t end = page.find("```", at);
    blocks.push_back(page.substr(at, end - at));
    at = end;
  }
  return blocks;
}

/// The block with the sections that it leaves out, so that it is a whole config.
std::string complete(const std::string& block) {
  std::string text = block;
  const auto add = [&](const std::string& key, const std::string& value) {
    if (!text.starts_with(key) && text.find('\n' + key) == std::string::npos) {
      text += key + ' ' + value + '\n';
    }
  };
  add("schema:", "1");
  add("crowd:", "{name: a, count: 1}");
  add("faces:", "{directory: heads, units: cm, tags: {ann: [old, female], bob: [female]}}");
  add("regions:", "{names: [top, middle, bottom], mask: mask.png}");
  return text;
}

TEST_F(ExampleConfigs, ThoseOfTheReferenceAreReadToo) {
  for (const char* name : {"ann", "bob", "cyd"}) {
    touch(concat("configs/heads/", name, ".obj"));
    touch(concat("scans/", name, ".obj"));
  }
  touch("configs/mask.png");
  touch("configs/body.obj");
  touch("configs/template/neutral.obj");
  touch("configs/template/shapes/smile.obj");
  for (const char* name : {"ann", "bob", "cyd"}) {
    touch(concat("configs/expressions/", name, "/jawOpen.obj"));
  }
  for (const char* name : {"bob", "crop", "cap", "round"}) {
    touch(concat("configs/attachments/", name, ".obj"));
  }
  touch("masks/bands.1001.png");
  const auto page = std::filesystem::path(CROWDFACE_SOURCE_DIR) / "docs/config.md";
  const std::vector<std::string> blocks = yaml_blocks(read_file(page));
  EXPECT_GE(blocks.size(), 8u);
  for (const std::string& block : blocks) {
    problems_ = Problems();
    EXPECT_TRUE(read_config(touch("configs/c.yaml", complete(block)), {}, problems_))
        << told() << '\n'
        << complete(block);
  }
}

TEST_F(ExampleConfigs, TheStarterReadsBack) {
  StarterFacts facts;
  facts.heads_folder = "heads";
  facts.head_names = {"ann", "bob", "cyd"};
  facts.units = LengthUnit::kInch;
  facts.head_height = 10.5;
  facts.units_reason = "the first head is 10.50 units tall";
  facts.up = {2, 1};
  facts.front = {1, -1};
  const std::string text = starter_config(facts);
  const auto config = read(text);
  ASSERT_TRUE(config) << told() << text;
  EXPECT_EQ(config->faces.names, facts.head_names);
  EXPECT_EQ(config->faces.units, LengthUnit::kInch);
  EXPECT_EQ(config->faces.up, facts.up);
  EXPECT_EQ(config->faces.front, facts.front);
  EXPECT_EQ(config->output.directory, folder_ / "out/crowd");
  EXPECT_THAT(text, testing::HasSubstr("because the first head is 10.50 units tall.\n"));
  EXPECT_THAT(text, testing::HasSubstr("26.7 cm high. PLEASE CHECK"));
}

// Without a distance, pairs at 0.9 mm passed for one person.
TEST_F(ExampleConfigs, TheStarterKeepsPeopleApart) {
  StarterFacts facts;
  facts.heads_folder = "heads";
  const auto proposed = [&](std::size_t heads) {
    facts.head_names.clear();
    for (std::size_t h = 0; h < heads; ++h) facts.head_names.push_back(concat("head_", h));
    const auto config = read(starter_config(facts));
    return config ? config->diversity->min_distance_mm : -1;
  };
  EXPECT_EQ(proposed(2), 0);
  EXPECT_EQ(proposed(3), 0.5);
  EXPECT_EQ(proposed(4), 0.8);
  EXPECT_EQ(proposed(5), 1);
  EXPECT_EQ(proposed(16), 1.2);
}

TEST_F(ExampleConfigs, TheStarterTakesAnyFolderName) {
  StarterFacts facts;
  facts.head_names = {"ann", "bob"};
  for (const char* folder : {"a b", "#1", "x: y", "it's \"so\"", "ü", "yes", "-"}) {
    facts.heads_folder = folder;
    touch(concat(folder, "/ann.obj"));
    touch(concat(folder, "/bob.obj"));
    EXPECT_TRUE(read(starter_config(facts))) << told();
  }
}

}  // namespace
}  // namespace crowdface
