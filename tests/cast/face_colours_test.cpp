// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_colours.h"

#include <algorithm>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crowdface {
namespace {

using ::testing::ElementsAre;

constexpr Index kHeads = 6;

/// Heads 0 to 2 are women, 3 to 5 men; 0 and 3 are pale.
ColourOptions six_heads() {
  ColourOptions draw;
  draw.seed = 5;
  draw.head_names = {"a", "b", "c", "d", "e", "f"};
  draw.tags = {{"pale", "woman"}, {"woman"}, {"woman"}, {"man", "pale"}, {"man"}, {"man"}};
  draw.tags_to_match = {"woman", "man"};
  return draw;
}

FacePlan face_on(Index target, std::uint64_t index) {
  FacePlan face;
  face.id = "face_" + std::to_string(index);
  face.index = index;
  face.recipe.target = target;
  return face;
}

FacePlan relative(const std::string& id, Index target, const std::string& family,
                  std::vector<std::string> parents = {}) {
  FacePlan face;
  face.id = id;
  face.family = family;
  face.recipe.target = target;
  face.parents = std::move(parents);
  return face;
}

double sum_of(const std::vector<SourceWeight>& colours) {
  double sum = 0;
  for (const SourceWeight& one : colours) sum += one.weight;
  return sum;
}

TEST(ColourDraw, AreThoseOfHeadsWithTheSameTagsEachAsOften) {
  std::vector<FacePlan> crowd;
  constexpr std::uint64_t kFaces = 3000;
  for (std::uint64_t i = 1; i <= kFaces; ++i) crowd.push_back(face_on(i % 2 == 0 ? 1 : 4, i));
  choose_colours(six_heads(), crowd);
  std::map<Index, int> first;
  for (const FacePlan& face : crowd) {
    const auto& colours = face.recipe.colours;
    ASSERT_EQ(colours.size(), 2U);
    EXPECT_NEAR(sum_of(colours), 1, 1e-12);
    for (const SourceWeight& one : colours) {
      EXPECT_EQ(one.head < 3, face.recipe.target < 3) << face.id;
      EXPECT_GT(one.weight, 0);
    }
    EXPECT_LT(colours[0].head, colours[1].head);
    ++first[std::ranges::max_element(colours, {}, &SourceWeight::weight)->head];
  }
  for (Index h = 0; h < kHeads; ++h) EXPECT_NEAR(first[h], kFaces / 6.0, 75) << h;
}

TEST(ColourDraw, WithoutAListAllTagsCountAndWithoutTagsNone) {
  ColourOptions draw = six_heads();
  draw.tags_to_match.reset();
  std::vector<FacePlan> crowd = {face_on(0, 1), face_on(5, 2)};
  choose_colours(draw, crowd);
  EXPECT_THAT(crowd[0].recipe.colours, ElementsAre(SourceWeight{0, 1})) << "no other is like her";
  for (const SourceWeight& one : crowd[1].recipe.colours) EXPECT_GE(one.head, 4);

  draw.tags.clear();
  std::map<Index, int> seen;
  for (std::uint64_t i = 1; i <= 200; ++i) {
    std::vector<FacePlan> one = {face_on(0, i)};
    choose_colours(draw, one);
    for (const SourceWeight& part : one[0].recipe.colours) ++seen[part.head];
  }
  EXPECT_EQ(seen.size(), 6U);
}

TEST(ColourDraw, NoFaceMattersToAnother) {
  std::vector<FacePlan> few, many;
  for (std::uint64_t i = 1; i <= 20; ++i) many.push_back(face_on(static_cast<Index>(i % 6), i));
  few.assign(many.begin() + 7, many.begin() + 12);
  choose_colours(six_heads(), few);
  choose_colours(six_heads(), many);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].recipe.colours, many[i + 7].recipe.colours);
  }
  std::vector<FacePlan> drawn_again = {face_on(1, 3)};
  drawn_again[0].notes.attempt = 4;
  choose_colours(six_heads(), drawn_again);
  EXPECT_NE(drawn_again[0].recipe.colours, many[2].recipe.colours);
}

TEST(ColourDraw, AFamilyHasOneComplexionAndAChildHasHalfOfEitherParents) {
  ColourOptions draw = six_heads();
  draw.tags_to_match = std::vector<std::string>{};
  std::vector<FacePlan> crowd = {face_on(0, 1),
                                 face_on(4, 2),
                                 relative("s1", 1, "sisters"),
                                 relative("s2", 2, "sisters"),
                                 relative("child", 5, "children", {"face_1", "face_2"}),
                                 relative("ward", 5, "wards", {"face_1", "b"}),
                                 relative("grandchild", 5, "grandchildren", {"child", "child"})};
  choose_colours(draw, crowd);
  EXPECT_EQ(crowd[2].recipe.colours, crowd[3].recipe.colours);
  std::map<Index, double> half;
  for (const std::size_t parent : {0U, 1U}) {
    for (const SourceWeight& one : crowd[parent].recipe.colours) half[one.head] += one.weight / 2;
  }
  ASSERT_EQ(crowd[4].recipe.colours.size(), half.size());
  for (const SourceWeight& one : crowd[4].recipe.colours) {
    EXPECT_NEAR(one.weight, half[one.head], 1e-12);
  }
  EXPECT_EQ(crowd[6].recipe.colours, crowd[4].recipe.colours);
  const auto& ward = crowd[5].recipe.colours;
  const auto b = std::ranges::find(ward, Index{1}, &SourceWeight::head);
  ASSERT_NE(b, ward.end());
  EXPECT_GE(b->weight, 0.5) << "a parent who is a head hands down its own";
}

TEST(ColourDraw, ASonHasNoneOfHisMothersThatASonCannotHave) {
  std::vector<FacePlan> crowd = {face_on(0, 1), face_on(3, 2),
                                 relative("son", 5, "sons", {"face_1", "face_2"}),
                                 relative("boy", 5, "boys", {"face_1", "face_1"})};
  choose_colours(six_heads(), crowd);
  EXPECT_EQ(crowd[2].recipe.colours, crowd[1].recipe.colours);
  for (const SourceWeight& one : crowd[3].recipe.colours) EXPECT_GE(one.head, 3);
}

TEST(ColourDraw, WhatIsWrittenByHandStaysAndIsHandedDown) {
  FacePlan written = relative("anna", 1, "");
  written.family.reset();
  written.recipe.colours = {{1, 0.25}, {2, 0.75}};
  std::vector<FacePlan> crowd = {written, relative("child", 1, "c", {"anna", "anna"})};
  choose_colours(six_heads(), crowd);
  EXPECT_EQ(crowd[0].recipe.colours, written.recipe.colours);
  EXPECT_EQ(crowd[1].recipe.colours, written.recipe.colours);
}

}  // namespace
}  // namespace crowdface
