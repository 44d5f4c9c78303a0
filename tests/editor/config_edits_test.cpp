// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/config_edits.h"

#include <gtest/gtest.h>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/config_reader.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

using testing::expect_error;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

ManualRecipe recipe(const std::string& id, Eigen::Index target) {
  ManualRecipe recipe;
  recipe.id = id;
  recipe.target = target;
  recipe.regions.resize(2);
  recipe.regions[0].position = PlanePoint(0.5, 0);
  return recipe;
}

class ConfigEdits : public ::testing::Test {
 protected:
  ConfigEdits() : folder_(two_regions()) {
    write_file(folder_.config(),
               concat(read_file(folder_.config()), "# mine\nrecipes:  # by hand\n",
                      "- {id: ada, target: ", folder_.names()[0], "}\n"));
  }
  static SmallCrowd two_regions() {
    SmallCrowd crowd;
    crowd.regions = 2;
    return crowd;
  }
  Config config() const {
    Problems problems;
    auto config = read_config(folder_.config(), {}, problems);
    problems.throw_if_any();
    return *config;
  }
  std::vector<std::string> recipes() const {
    std::vector<std::string> found;
    for (const ManualRecipe& one : config().recipes)
      found.push_back(concat(one.id, one.target.value()));
    return found;
  }

  SmallCrowdFolder folder_;
};

using Recipes = std::vector<std::string>;

TEST_F(ConfigEdits, RecipesStandInAFileThatTheConfigNames) {
  const std::string before = read_file(folder_.config());
  const auto file = save_recipe_in_edits(recipe("eva", 1), config());
  EXPECT_EQ(read_file(folder_.config()),
            concat(before, "\nedits: ", file.filename().string(), "  # saved by crowdface edit\n"));
  EXPECT_EQ(recipes(), (Recipes{"ada0", "eva1"}));
  const std::string named = read_file(folder_.config());
  EXPECT_EQ(save_recipe_in_edits(recipe("zoe", 2), config()), file);
  save_recipe_in_edits(recipe("eva", 3), config());
  save_recipe_in_edits(recipe("ada", 1), config());
  EXPECT_EQ(read_file(folder_.config()), named);
  EXPECT_EQ(recipes(), (Recipes{"ada1", "eva3", "zoe2"}));
  EXPECT_EQ(config().recipes[1].regions[0].position, PlanePoint(0.5, 0));
  EXPECT_EQ(config().edits, file);
}

TEST_F(ConfigEdits, RegionsTakeThePlaceOfThoseOfTheConfig) {
  const std::filesystem::path mask = folder_ / "mask_0.png";
  save_regions_in_edits(folder_.config(), {"brow", "jaw"}, {mask});
  const auto file = save_recipe_in_edits(recipe("eva", 1), config());
  EXPECT_EQ(recipes(), (Recipes{"ada0", "eva1"}));
  EXPECT_EQ(file, config().edits);
  EXPECT_EQ(config().regions.names, (std::vector<std::string>{"brow", "jaw"}));
}

TEST_F(ConfigEdits, HeadsComeAfterThoseOfTheConfig) {
  const std::filesystem::path more = folder_ / "more";
  std::filesystem::create_directory(more);
  for (const char* name : {"eva.obj", "zoe.obj"}) {
    std::filesystem::copy_file(folder_.head(folder_.names()[0]), more / name);
  }
  std::vector<std::string> names = folder_.names();
  const auto file = save_heads_in_edits(folder_.config(), {more / "eva.obj"});
  const auto one = section_in_edits(file, "faces");
  EXPECT_EQ(one, "{also: [more/eva.obj]}");
  save_heads_in_edits(folder_.config(), {more / "zoe.obj"});
  names.insert(names.end(), {"eva", "zoe"});
  EXPECT_EQ(config().faces.names, names);
  expect_error(ExitCode::kUsage, {"two heads are called"},
               [&] { save_heads_in_edits(folder_.config(), {more / "eva.obj"}); });
  restore_section(folder_.config(), "faces", one);
  names.pop_back();
  EXPECT_EQ(config().faces.names, names);
  restore_section(folder_.config(), "faces", std::nullopt);
  EXPECT_EQ(config().faces.names, folder_.names());
}

TEST_F(ConfigEdits, ThatTheConfigWouldRefuseChangeNothing) {
  const auto file = save_recipe_in_edits(recipe("eva", 1), config());
  const std::string config_text = read_file(folder_.config()), edits = read_file(file);
  expect_error(ExitCode::kUsage, {"belong to the sampled faces"},
               [&] { save_recipe_in_edits(recipe(config().crowd.name + "_0001", 1), config()); });
  expect_error(ExitCode::kUsage, {"region_2"}, [&] {
    save_regions_in_edits(folder_.config(), {"region_1"}, {folder_ / "mask_0.png"});
  });
  EXPECT_EQ(read_file(folder_.config()), config_text);
  EXPECT_EQ(read_file(file), edits);
}

TEST_F(ConfigEdits, OfAConfigInBracesAreNamedByHand) {
  const std::string text = concat("{schema: 1, crowd: {name: mob, count: 1}, faces: {directory: ",
                                  (folder_ / "heads").string(), ", units: cm}}\n");
  write_file(folder_.config(), text);
  Config plain = config();
  ManualRecipe open = recipe("eva", 1);
  open.regions.resize(1);
  expect_error(ExitCode::kUsage, {"add \"edits: "}, [&] { save_recipe_in_edits(open, plain); });
  EXPECT_EQ(read_file(folder_.config()), text);
}

TEST_F(ConfigEdits, AreRefusedWhereTheFileIsMissingOrHoldsSomethingElse) {
  const auto file = save_recipe_in_edits(recipe("eva", 1), config());
  write_file(file, "sampling: {max_sources: 1}\n");
  expect_error(ExitCode::kUsage, {"sampling"}, [&] { config(); });
  remove_if_exists(file);
  expect_error(ExitCode::kMissingInput, {file.filename().string()}, [&] { config(); });
}

}  // namespace
}  // namespace crowdface
