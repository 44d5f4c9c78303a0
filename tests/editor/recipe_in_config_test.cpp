// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/recipe_in_config.h"

#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

#include "support/expect_error.h"

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

TEST(RecipeInConfig, RefusesAListInOneLine) {
  testing::expect_error(ExitCode::kUsage, {"[brackets]"},
                        [] { with("recipes: [{id: ada}]\n", "eva"); });
}

}  // namespace
}  // namespace crowdface
