// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/skin_draw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crowdface {
namespace {

/// Tones 0, 10, 20, 30 of women, then of men.
SkinOptions draw_of() {
  SkinOptions draw{3, {}, {}, {0, 10, 20, 30, 0, 10, 20, 30}, {}};
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h"}) draw.head_names.push_back(name);
  for (int h = 0; h < 8; ++h) draw.tags.push_back({h < 4 ? "female" : "male"});
  draw.colour_weights = [](const Recipe& recipe) {
    std::vector<double> shares(8, 0.0);
    for (const SourceWeight& one : recipe.colours) {
      shares[static_cast<std::size_t>(one.head)] = one.weight;
    }
    if (recipe.colours.empty()) shares[static_cast<std::size_t>(recipe.target)] = 1;
    return shares;
  };
  return draw;
}

double tone_of(const FacePlan& face) {
  double tone = 0;
  for (const SourceWeight& one : face.recipe.colours) {
    tone += one.weight * 10 * static_cast<double>(one.head % 4);
  }
  return tone;
}

FacePlan child_of(const std::string& id, const std::string& mother, const std::string& father,
                  Index target) {
  FacePlan child;
  child.id = id;
  child.family = "clan";
  child.parents = {mother, father};
  child.recipe.target = target;
  return child;
}

TEST(SkinDraw, AChildLiesBetweenItsParents) {
  for (int i = 0; i < 40; ++i) {
    FacePlan mother;
    mother.id = "mum";
    mother.recipe.target = 1;
    // The son of a face of tone 10 and a head of tone 30; his own target is light.
    std::vector<FacePlan> crowd = {mother, child_of("son_" + std::to_string(i), "mum", "h", 4),
                                   child_of("daughter", "a", "son_" + std::to_string(i), 3)};
    choose_skin_colours_of_children(draw_of(), crowd);
    EXPECT_TRUE(crowd[0].recipe.colours.empty()) << "nobody's child";
    for (const SourceWeight& one : crowd[1].recipe.colours) EXPECT_GE(one.head, 4) << "men lend";
    EXPECT_GE(tone_of(crowd[1]), 14 - 1e-9);
    EXPECT_LE(tone_of(crowd[1]), 26 + 1e-9);
    EXPECT_LT(tone_of(crowd[2]), tone_of(crowd[1])) << "the next generation";
    EXPECT_GT(tone_of(crowd[2]), 0);
  }
}

TEST(SkinDraw, TwinsHaveOneTone) {
  SkinOptions draw = draw_of();
  draw.twin_families = {"clan"};
  std::vector<FacePlan> crowd = {child_of("ona", "a", "h", 1), child_of("una", "a", "h", 2)};
  choose_skin_colours_of_children(draw, crowd);
  EXPECT_EQ(crowd[0].recipe.colours, crowd[1].recipe.colours);
}

TEST(SkinDraw, ColoursOfARecipeStay) {
  FacePlan child = child_of("son", "a", "h", 4);
  child.recipe.colours = {{7, 1}};
  std::vector<FacePlan> crowd = {child};
  choose_skin_colours_of_children(draw_of(), crowd);
  EXPECT_EQ(crowd[0].recipe.colours, child.recipe.colours);
}

TEST(SkinDraw, TheNearestHeadLendsWhereNoneIsBeyond) {
  SkinOptions draw = draw_of();
  draw.tags[7] = {"male", "old"};  // men without age have the tones 0 to 20
  std::vector<FacePlan> crowd = {child_of("son", "d", "h", 4)};
  choose_skin_colours_of_children(draw, crowd);
  EXPECT_EQ(crowd[0].recipe.colours, (std::vector<SourceWeight>{{6, 1}}));
}

}  // namespace
}  // namespace crowdface
