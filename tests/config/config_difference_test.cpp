// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_difference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crowdface {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kOld =
    "crowd:\n  name: mob\n  seed: 1\nreview: [a.yaml]\nmeshes: [obj, ply]\n";

TEST(ConfigDifference, LayoutAndCommentsAreNone) {
  EXPECT_THAT(config_differences(kOld,
                                 "crowd: {seed: 1, name: mob}  # mine\nmeshes:\n  - obj\n"
                                 "  - ply\nreview: [a.yaml]\n"),
              IsEmpty());
}

TEST(ConfigDifference, TheKeyIsNamedWhereverItStands) {
  const std::string old = kOld;
  EXPECT_THAT(config_differences(
                  old, "crowd: {name: mob, seed: 2}\nreview: [a.yaml]\nmeshes: [obj, ply]\n"),
              ElementsAre("crowd.seed"));
  EXPECT_THAT(config_differences(old, "crowd: {name: mob}\nreview: [a.yaml]\nmeshes: [obj, ply]\n"),
              ElementsAre("crowd.seed"));
  EXPECT_THAT(config_differences(old, old + "extra: 1\n"), ElementsAre("extra"));
  EXPECT_THAT(config_differences(
                  old, "crowd: {name: mob, seed: 1}\nreview: [a.yaml]\nmeshes: [ply, obj]\n"),
              ElementsAre("meshes"));
}

TEST(ConfigDifference, FurtherReviewsAreTheSameCrowdButNotOthersOrFewer) {
  const std::string rest = "crowd: {name: mob, seed: 1}\nmeshes: [obj, ply]\n";
  EXPECT_THAT(config_differences(kOld, rest + "review: [a.yaml, b.yaml]\n"), IsEmpty());
  EXPECT_THAT(config_differences(kOld, rest + "review: []\n"), IsEmpty());
}

// A new key had every finished crowd refused.
TEST(ConfigDifference, AKeyThatTheOldConfigDidNotKnowHasItsDefaultThere) {
  const std::string old = "crowd: {name: mob}\ndiversity: {mode: first_fit}\n";
  const auto with = [](const std::string& key) {
    return "crowd: {name: mob}\ndiversity: {mode: first_fit, " + key + "}\n";
  };
  EXPECT_THAT(config_differences(old, with("max_weight: 1")), IsEmpty());
  EXPECT_THAT(config_differences(old, with("max_weight: 0.5")),
              ElementsAre("diversity.max_weight"));
  EXPECT_THAT(config_differences(old, old + "distance: {area: front}\n"), IsEmpty());
  EXPECT_THAT(config_differences(old, old + "distance: {area: skin}\n"),
              ElementsAre("distance.area"))
      << "of a section that the old config lacks, too";
}

TEST(ConfigDifference, WhatGroupsHaveFromSamplingIsToldOnce) {
  const auto config = [](const std::string& common, const std::string& own) {
    return "sampling: {max_sources: " + common +
           ", age: 0}\ngroups:\n  - {name: old, max_sources: " + own + ", age: 1}\n";
  };
  EXPECT_THAT(config_differences(config("3", "3"), config("4", "4")),
              ElementsAre("sampling.max_sources"));
  EXPECT_THAT(config_differences(config("3", "3"), config("3", "4")), ElementsAre("groups"));
  EXPECT_THAT(config_differences(config("3", "2"), config("4", "2")),
              ElementsAre("sampling.max_sources"));
  EXPECT_THAT(config_differences(config("3", "2"), config("4", "1")),
              ElementsAre("sampling.max_sources", "groups"));
}

TEST(ConfigDifference, KeysOnWhichNoRecipeDependsMayChange) {
  const std::string old =
      "crowd: {name: mob}\noutput: {meshes: [obj], contact_sheet: {rows: 4}}\ntextures: {size: 8}\n"
      "attachments: {items: [{name: bob, kind: hair, file: a.obj}]}\nshapes: none\n";
  EXPECT_THAT(config_differences(
                  old,
                  "crowd: {name: mob}\noutput: {meshes: [ply], lods: [50 %], contact_sheet: none}\n"
                  "textures: {size: 16, formats: [png]}\nshapes: {directory: s}\npoints: p.yaml\n"
                  "attachments: {items: [{name: bob, kind: hair, file: b.obj, moves: rigid}]}\n"),
              IsEmpty());
  EXPECT_THAT(
      config_differences(
          old,
          "crowd: {name: mob}\noutput: {meshes: [obj]}\ntextures: {size: 8, colours: drawn}\n"
          "attachments: {items: [{name: bob, kind: hat, file: a.obj}]}\nshapes: none\n"),
      ElementsAre("textures.colours", "attachments.items"));
}

TEST(ConfigDifference, ACrowdMayGrow) {
  const auto with = [](const char* count, const char* mode) {
    return std::string("crowd: {name: mob, count: ") + count + "}\ndiversity: {mode: " + mode +
           "}\n";
  };
  EXPECT_THAT(config_differences(with("5", "first_fit"), with("9", "first_fit")), IsEmpty());
  EXPECT_THAT(config_differences(with("9", "first_fit"), with("5", "first_fit")),
              ElementsAre("crowd.count"));
  EXPECT_THAT(config_differences(with("5", "spread"), with("9", "spread")),
              ElementsAre("crowd.count"));
}

TEST(ConfigDifference, WhatCannotBeReadDiffers) {
  EXPECT_THAT(config_differences("crowd: [", kOld), Not(IsEmpty()));
  EXPECT_THAT(config_differences("", kOld), Not(IsEmpty()));
}

}  // namespace
}  // namespace crowdface
