// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "crowdface/config/yaml.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/config_text.h"

namespace crowdface {
namespace {

Config config() {
  Config config;
  config.faces.names = {"ann", "bob"};
  return config;
}

HandRecipe recipe(const std::string& id) {
  HandRecipe recipe;
  recipe.id = id;
  recipe.target = 1;
  recipe.regions.resize(1);
  recipe.regions[0].position = PlanePoint(0.5, 0);
  return recipe;
}

std::string with(const std::string& text, const std::string& id) {
  return with_recipe(text, "c.yaml", recipe(id), config());
}

constexpr const char* kEva =
    "id: eva\n    target: bob\n    regions:\n      all: {position: [0.5, 0]}\n";

TEST(RecipeInConfig, BecomesTheLastSection) {
  EXPECT_EQ(with("schema: 1  # one\n", "eva"), concat("schema: 1  # one\n\nrecipes:\n  - ", kEva));
}

TEST(RecipeInConfig, ComesAfterTheLastAndBeforeWhatFollows) {
  EXPECT_EQ(
      with("recipes:  # by hand\n  # first\n  - id: ada\n    target: ann  # her\n\n# out\noutput: "
           "{}\n",
           "eva"),
      concat("recipes:  # by hand\n  # first\n  - id: ada\n    target: ann  # her\n  - ", kEva,
             "\n# out\noutput: {}\n"));
}

TEST(RecipeInConfig, ReplacesTheOneOfItsName) {
  EXPECT_EQ(
      with("recipes:\n  - {id: ada}\n  - id: eva\n    target: ann\n    regions:\n      all: {}\n"
           "  # last\n  - id: zoe\n",
           "eva"),
      concat("recipes:\n  - {id: ada}\n  - ", kEva, "  # last\n  - id: zoe\n"));
}

TEST(RecipeInConfig, KeepsADashWithoutIndentation) {
  EXPECT_EQ(with("recipes:\n- id: ada\nseed: 1\n", "eva"),
            "recipes:\n- id: ada\n- id: eva\n  target: bob\n  regions:\n    all: {position: [0.5, "
            "0]}\nseed: 1\n");
}

TEST(RecipeInConfig, FillsAnEmptyList) {
  EXPECT_EQ(with("recipes: []\nseed: 1\n", "eva"), concat("recipes:\n  - ", kEva, "seed: 1\n"));
}

TEST(RecipeInConfig, KeepsTheCommentOfAnEmptyList) {
  for (const char* nothing : {"[]", "[ ]", "~", "null"}) {
    EXPECT_EQ(with(concat("recipes: ", nothing, "  # none yet\nseed: 1\n"), "eva"),
              concat("recipes:  # none yet\n  - ", kEva, "seed: 1\n"))
        << nothing;
  }
  EXPECT_EQ(with("recipes:  # none yet\n", "eva"), concat("recipes:  # none yet\n  - ", kEva));
}

/// \param column  that the item begins in.
std::string eva_in_braces(std::size_t column) {
  const std::string next = concat(",\n", std::string(column + 1, ' '));
  return concat("{id: eva", next, "target: bob", next, "regions: {all: {position: [0.5, 0]}}}");
}

TEST(RecipeInConfig, JoinsAListInOneLine) {
  EXPECT_EQ(with("recipes: [{id: ada}]  # by hand\nseed: 1\n", "eva"),
            concat("recipes: [{id: ada}, ", eva_in_braces(21), "]  # by hand\nseed: 1\n"));
  EXPECT_EQ(with("recipes: [{id: ada}, ]\n", "eva"),
            concat("recipes: [{id: ada}, ", eva_in_braces(21), " ]\n"));
}

TEST(RecipeInConfig, JoinsAListInBracketsAsItStands) {
  EXPECT_EQ(with("recipes: [  # by hand\n  {id: ada, target: ann},  # ], she\n"
                 "  # the second\n  {\"id\":'zoe''s, {', target: it's#2}  # last\n  # none "
                 "more\n]\nseed: 1\n",
                 "eva"),
            concat("recipes: [  # by hand\n  {id: ada, target: ann},  # ], she\n"
                   "  # the second\n  {\"id\":'zoe''s, {', target: it's#2},  # last\n  ",
                   eva_in_braces(2), "\n  # none more\n]\nseed: 1\n"));
  EXPECT_EQ(with("recipes:\n  [\n    {id: ada},\n    {id: zoe}]\n", "eva"),
            concat("recipes:\n  [\n    {id: ada},\n    {id: zoe},\n    ", eva_in_braces(4), "]\n"));
  EXPECT_EQ(with("recipes: [\n  # none yet\n]\n", "eva"),
            concat("recipes: [\n  # none yet\n  ", eva_in_braces(2), "\n]\n"));
}

TEST(RecipeInConfig, ReplacesTheOneOfItsNameInBrackets) {
  EXPECT_EQ(
      with("recipes: [\n  {id: ada},\n  {id: eva, target: ann}, # her\n  {id: zoe}]\n", "eva"),
      concat("recipes: [\n  {id: ada},\n  ", eva_in_braces(2), ", # her\n  {id: zoe}]\n"));
}

TEST(RecipeInConfig, JoinsAConfigThatIsOneMapInBraces) {
  EXPECT_EQ(with("{schema: 1, crowd: {name: \"é\"}, recipes: []}\n", "eva"),
            concat("{schema: 1, crowd: {name: \"é\"}, recipes: [", eva_in_braces(43), "]}\n"));
}

// Whatever the list looks like, what comes out is YAML that holds the recipe once, at its place.
TEST(RecipeInConfig, ReadsBack) {
  const std::vector<std::string> lists = {
      "[]",
      "[ # a ]\n ]",
      "[{id: a}]",
      "[{id: a},]",
      "[ {id: a} ,\n # {id: eva}\n ]",
      "[{id: 'a]'}, {id: \"b\\\"}\", target: x}]",
      "[\n {id: a,\n  regions: {all: {weights: {x: 1, y: 2}}}}\n]",
      "[{id: a b 'c, target: d:e}, {id: eva}, {id: f}]",
      "\n - id: a\n - {id: eva}"};
  for (const std::string& list : lists) {
    const std::string text = with(concat("seed: 1\nrecipes: ", list, "\nname: x\n"), "eva");
    Complaints complaints;
    const auto root = parse_yaml(text, "c.yaml", complaints);
    ASSERT_TRUE(root && complaints.empty()) << text;
    const YamlEntry* recipes = root->find("recipes");
    ASSERT_NE(recipes, nullptr) << text;
    int found = 0;
    for (const YamlNode& item : recipes->value.items) {
      if (item.find("id")->value.text != "eva") continue;
      ++found;
      EXPECT_EQ(item.find("target")->value.text, "bob") << text;
    }
    EXPECT_EQ(found, 1) << text;
    EXPECT_EQ(root->find("name")->value.text, "x") << text;
    for (const char* comment : {"# a ]", "# {id: eva}"}) {
      EXPECT_EQ(list.find(comment) == list.npos, text.find(comment) == text.npos) << text;
    }
  }
}

}  // namespace
}  // namespace crowdface
