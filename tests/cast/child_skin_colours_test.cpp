// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/child_skin_colours.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crowdface {
namespace {

/// Tones 0, 10, 20, 30 of women, then of men.
ChildSkinOptions draw_of() {
  ChildSkinOptions draw{3, {}, {}, {0, 10, 20, 30, 0, 10, 20, 30}, {}};
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
    EXPECT_GE(tone_of(crowd[1]), 16 - 1e-9);
    EXPECT_LE(tone_of(crowd[1]), 24 + 1e-9);
    EXPECT_LT(tone_of(crowd[2]), tone_of(crowd[1])) << "the next generation";
    EXPECT_GT(tone_of(crowd[2]), 0);
  }
}

TEST(SkinDraw, TwinsHaveOneTone) {
  ChildSkinOptions draw = draw_of();
  draw.twin_families = {"clan"};
  std::vector<FacePlan> crowd = {child_of("ona", "a", "h", 1), child_of("una", "a", "h", 2)};
  choose_skin_colours_of_children(draw, crowd);
  EXPECT_EQ(crowd[0].recipe.colours, crowd[1].recipe.colours);
}

TEST(SkinDraw, ColoursBetweenTheParentsStay) {
  FacePlan child = child_of("son", "a", "h", 4);
  child.recipe.colours = {{5, 0.5}, {6, 0.5}};
  std::vector<FacePlan> crowd = {child};
  choose_skin_colours_of_children(draw_of(), crowd);
  EXPECT_EQ(crowd[0].recipe.colours, child.recipe.colours);
}

// `colours: drawn` gives a daughter only the colours of her mother's heads.
TEST(SkinDraw, ColoursOfOneParentAreReplaced) {
  FacePlan child = child_of("daughter", "a", "h", 1);
  child.recipe.colours = {{0, 1}};
  std::vector<FacePlan> crowd = {child};
  choose_skin_colours_of_children(draw_of(), crowd);
  EXPECT_GE(tone_of(crowd[0]), 9 - 1e-9);
  EXPECT_LE(tone_of(crowd[0]), 21 + 1e-9);
}

/// Returns the total weight of the heads in [begin, end).
double weight_of(const FacePlan& face, Index begin, Index end) {
  double sum = 0;
  for (const SourceWeight& one : face.recipe.colours) {
    if (one.head >= begin && one.head < end) sum += one.weight;
  }
  return sum;
}

TEST(SkinDraw, HeadsMayHaveNoTags) {
  ChildSkinOptions draw = draw_of();
  draw.tags.clear();
  std::vector<FacePlan> crowd = {child_of("girl", "a", "h", 1)};
  choose_skin_colours_of_children(draw, crowd);
  EXPECT_GE(tone_of(crowd[0]), 9 - 1e-9);
  EXPECT_LE(tone_of(crowd[0]), 21 + 1e-9);
}

TEST(SkinDraw, AnotherAgeLendsAsLittleAsPossibleIfNoLikeHeadIsDarkEnough) {
  ChildSkinOptions draw = draw_of();
  draw.tags[2] = draw.tags[3] = {"female", "old"};  // young women have the tones 0 and 10
  double darkest = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<FacePlan> crowd = {child_of("girl_" + std::to_string(i), "a", "h", 1)};
    choose_skin_colours_of_children(draw, crowd);
    EXPECT_GE(tone_of(crowd[0]), 9 - 1e-9);
    EXPECT_LE(tone_of(crowd[0]), 21 + 1e-9);
    darkest = std::max(darkest, tone_of(crowd[0]));
    EXPECT_EQ(weight_of(crowd[0], 4, 8), 0) << "no man's skin";
    // Head 3 (tone 30) reaches each tone with less old skin than head 2 (tone 20).
    const double old = std::max(0.0, (tone_of(crowd[0]) - 10) / 20);
    EXPECT_NEAR(weight_of(crowd[0], 2, 4), old, 1e-9);
  }
  EXPECT_GT(darkest, 19);
}

TEST(SkinDraw, ADaughterWhoseSexHasOnlyLightHeadsIsDarkerThanHerMother) {
  ChildSkinOptions draw = draw_of();
  draw.tones = {0, 1, 2, 3, 0, 10, 20, 30};  // all women are light
  for (int i = 0; i < 40; ++i) {
    std::vector<FacePlan> crowd = {child_of("girl_" + std::to_string(i), "b", "h", 1)};
    choose_skin_colours_of_children(draw, crowd);
    double tone = 0;
    for (const SourceWeight& one : crowd[0].recipe.colours) {
      tone += one.weight * draw.tones[static_cast<std::size_t>(one.head)];
    }
    EXPECT_GE(tone, 1 + 0.3 * 29 - 1e-9);
    EXPECT_LE(tone, 1 + 0.7 * 29 + 1e-9);
    EXPECT_NEAR(weight_of(crowd[0], 4, 8), (tone - 3) / 27, 1e-9) << "the least of a man's skin";
  }
}

}  // namespace
}  // namespace crowdface
