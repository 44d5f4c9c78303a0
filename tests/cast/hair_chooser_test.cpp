// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/hair_chooser.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr Index kYoungHead = 0, kOldHead = 1;

/// Sampled faces; every third face is old.
std::vector<FacePlan> mixed_ages(std::uint64_t count) {
  std::vector<FacePlan> crowd;
  for (std::uint64_t index = 1; index <= count; ++index) {
    FacePlan& face = crowd.emplace_back();
    face.id = concat("mob_", index);
    face.index = index;
    face.recipe.target = index % 3 == 0 ? kOldHead : kYoungHead;
  }
  return crowd;
}

HairOptions red_hair(double share) {
  return {3,
          {{"young", "black_hair"}, {"old", "black_hair"}},
          {"ann", "bob"},
          {{"", {{"red", share}}}},
          {}};
}

std::vector<HairColour> colours_of(const std::vector<FacePlan>& crowd, double share) {
  HairChooser chooser(red_hair(share), crowd);
  std::vector<HairColour> colours;
  for (const FacePlan& face : crowd) colours.push_back(chooser.colour_of(face, face.recipe.target));
  return colours;
}

bool is_red(const HairColour& colour) {
  return is_shade_of(colour, *hair_colour_named("red"));
}

std::ptrdiff_t count_of_visibly_red(const std::vector<HairColour>& colours) {
  return std::ranges::count_if(
      colours, [](const HairColour& colour) { return is_red(colour) && !looks_grey(colour); });
}

// Of four red-haired faces in twenty, two were grey: nobody saw their red.
TEST(HairSampling, AskedColoursAreVisible) {
  const std::uint64_t count = 60;
  const std::vector<HairColour> colours = colours_of(mixed_ages(count), 0.2);
  EXPECT_GE(std::ranges::count_if(colours, looks_grey), 15);
  EXPECT_NEAR(static_cast<double>(count_of_visibly_red(colours)), 0.2 * count, 1);
}

TEST(HairSampling, ALargerCrowdKeepsItsColours) {
  const std::vector<HairColour> few = colours_of(mixed_ages(20), 0.2);
  const std::vector<HairColour> many = colours_of(mixed_ages(60), 0.2);
  EXPECT_EQ(few, std::vector<HairColour>(many.begin(), many.begin() + 20));
}

TEST(HairSampling, ARedrawnFaceKeepsTheColourOfTheRejectedFace) {
  const std::vector<FacePlan> crowd = mixed_ages(20);
  HairChooser chooser(red_hair(0.3), crowd);
  std::vector<bool> red;
  for (const FacePlan& face : crowd) red.push_back(is_red(chooser.colour_of(face, kYoungHead)));
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    FacePlan redrawn = crowd[i];
    redrawn.recipe.target = kOldHead;
    EXPECT_EQ(is_red(chooser.colour_of(redrawn, kOldHead)), red[i]) << redrawn.id;
  }
}

// An age of 45 years, which moved a third of the weights to old heads, made hair half grey.
TEST(HairSampling, GreyDependsOnTheYears) {
  const auto mean_grey = [](double years) {
    std::vector<FacePlan> crowd = mixed_ages(60);
    for (FacePlan& face : crowd) {
      face.age = 0.5;
      face.age_years = years;
    }
    double sum = 0;
    for (const HairColour& colour : colours_of(crowd, 0)) sum += colour.grey_fraction;
    return sum / 60;
  };
  EXPECT_EQ(mean_grey(30), 0);
  EXPECT_LT(mean_grey(45), 0.1);
  EXPECT_NEAR(mean_grey(57), 0.35, 0.1);
  EXPECT_GT(mean_grey(70), 0.9);
}

TEST(HairSampling, NobodyLosesAColourIfAllFacesHaveOne) {
  const std::vector<HairColour> colours = colours_of(mixed_ages(30), 1);
  EXPECT_TRUE(std::ranges::all_of(colours, is_red));
}

}  // namespace
}  // namespace crowdface
