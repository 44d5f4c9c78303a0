// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_difference.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

constexpr const char* kOld =
    "crowd:\n  name: mob\n  seed: 1\nreview: [a.yaml]\nmeshes: [obj, ply]\n";

TEST(ConfigDifference, LayoutAndCommentsAreNone) {
  EXPECT_EQ(config_difference(kOld,
                              "crowd: {seed: 1, name: mob}  # mine\nmeshes:\n  - obj\n"
                              "  - ply\nreview: [a.yaml]\n"),
            std::nullopt);
}

TEST(ConfigDifference, TheKeyIsNamedWhereverItStands) {
  const std::string old = kOld;
  EXPECT_EQ(
      config_difference(old, "crowd: {name: mob, seed: 2}\nreview: [a.yaml]\nmeshes: [obj, ply]\n"),
      "crowd.seed");
  EXPECT_EQ(config_difference(old, "crowd: {name: mob}\nreview: [a.yaml]\nmeshes: [obj, ply]\n"),
            "crowd.seed");
  EXPECT_EQ(config_difference(old, old + "extra: 1\n"), "extra");
  EXPECT_EQ(
      config_difference(old, "crowd: {name: mob, seed: 1}\nreview: [a.yaml]\nmeshes: [ply, obj]\n"),
      "meshes");
}

TEST(ConfigDifference, FurtherReviewsAreTheSameCrowdButNotOthersOrFewer) {
  const std::string rest = "crowd: {name: mob, seed: 1}\nmeshes: [obj, ply]\n";
  EXPECT_EQ(config_difference(kOld, rest + "review: [a.yaml, b.yaml]\n"), std::nullopt);
  EXPECT_EQ(config_difference(kOld, rest + "review: []\n"), std::nullopt);
}

// A new key had every finished crowd refused.
TEST(ConfigDifference, AKeyThatTheOldConfigDidNotKnowHasItsDefaultThere) {
  const std::string old = "crowd: {name: mob}\noutput: {directory: ., contact_sheet: {rows: 4}}\n";
  const auto with = [](const std::string& key, const std::string& of_sheet) {
    return "crowd: {name: mob}\noutput: {directory: ., " + key + "contact_sheet: {rows: 4" +
           of_sheet + "}}\n";
  };
  EXPECT_EQ(config_difference(old, with("subdivision: none, ", ", texture: auto")), std::nullopt);
  EXPECT_EQ(config_difference(old, with("subdivision: catmull_clark, ", "")), "output.subdivision");
  EXPECT_EQ(config_difference(old, with("", ", texture: false")), "output.contact_sheet.texture");
  EXPECT_EQ(config_difference(old, old + "textures: {blend: auto, size: 2048}\n"), "textures.size")
      << "of a section that the old config lacks, too";
}

TEST(ConfigDifference, WhatCannotBeReadDiffers) {
  EXPECT_NE(config_difference("crowd: [", kOld), std::nullopt);
  EXPECT_NE(config_difference("", kOld), std::nullopt);
}

}  // namespace
}  // namespace crowdface
