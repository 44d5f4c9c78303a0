// SPDX-License-Identifier: Apache-2.0
// The sections that say how a crowd is cast, and reviews.
#include <gmock/gmock.h>

#include "crowdface/cast/diversity.h"
#include "crowdface/cast/family.h"
#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/config/config_reader.h"
#include "crowdface/core/text.h"

#include "config/config_test_folder.h"

namespace crowdface {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(ConfigTest, CastingIsRead) {
  const auto config =
      read(kBands +
           "diversity: {mode: spread, min_distance: 1.5 mm, min_distance_to_faces: "
           "1 mm, max_weight: 0.7, pool: 10, max_attempts: 1000}\n"  // as older crowds have it
           "distance: {area: skin}\n"
           "believability: {max_deviation: 2, max_stretch: 4, max_flipped: 0.01, "
           "max_intersecting: 0.02, meshes: none}\n"
           "families:\n"
           "  - {name: smith, members: 2, target: bob, max_distance: 2 mm}\n"
           "  - {name: jones, members: 3, parents: {mother: ann, father: smith_02}, "
           "max_distance: 2 mm, min_distance: 0.5 mm}\n");
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->diversity->mode, DiversityOptions::Mode::kSpread);
  EXPECT_EQ(config->diversity->min_distance_mm, 1.5);
  EXPECT_EQ(config->diversity->min_distance_to_heads_mm, 1);
  EXPECT_EQ(config->diversity->max_weight, 0.7);
  EXPECT_EQ(config->distance.area, ComparedArea::kSkin);
  EXPECT_EQ(config->believability->max_stretch, 4);
  EXPECT_EQ(config->believability->meshes, BelievabilityOptions::MeshChecks::kNone);
  ASSERT_EQ(config->families.size(), 2U);
  EXPECT_EQ(config->families[0].target, 1);
  EXPECT_EQ(config->families[1].parents[0].head, 0);
  EXPECT_EQ(config->families[1].parents[1].id, "smith_02");
  EXPECT_EQ(config->families[1].min_distance_mm, 0.5);
}

TEST_F(ConfigTest, GroupsTakeWhatTheyDoNotSayFromSampling) {
  const auto config = read(
      "schema: 1\ncrowd: {name: mob, count: 10}\n"
      "faces: {directory: heads, units: cm, tags: {ann: [old, female], bob: [old], "
      "cyd: [female]}}\n"
      "sampling: {targets: [bob], extrapolation: 1.1, max_sources: 2}\n"
      "groups:\n"
      "  - {name: elderly, share: 0.3, tags: [old, female], age: 0.5, max_sources: all}\n"
      "  - {name: two, count: 2, sources: [cyd]}\n"
      "  - {name: rest}\n"
      "families: [{name: kin, members: 1, group: two, parents: {mother: drawn, "
      "father: {group: elderly}}}]\n");
  ASSERT_TRUE(config) << told();
  ASSERT_EQ(config->groups.size(), 3U);
  const Group &elderly = config->groups[0], &two = config->groups[1], &rest = config->groups[2];
  ASSERT_EQ(elderly.sampling.targets.size(), 1U);
  EXPECT_EQ(elderly.sampling.targets[0].head, 0);
  EXPECT_THAT(elderly.sampling.sources, ElementsAre(0));
  EXPECT_EQ(elderly.sampling.age.range.high, 0.5);
  EXPECT_FALSE(elderly.sampling.max_sources);
  EXPECT_EQ(elderly.sampling.regions[0].extrapolation.low, 1.1);
  EXPECT_EQ(two.count, 2U);
  EXPECT_EQ(two.sampling.targets[0].head, 1);
  EXPECT_THAT(two.sampling.sources, ElementsAre(2));
  EXPECT_DOUBLE_EQ(rest.share, 0.7);
  EXPECT_EQ(rest.sampling.max_sources, 2);
  const FamilyOptions& kin = config->families[0];
  EXPECT_EQ(kin.group, 1U);
  EXPECT_TRUE(kin.parents[0].is_new);
  EXPECT_EQ(kin.parents[0].id, "kin_mother");
  EXPECT_FALSE(kin.parents[0].group);
  EXPECT_EQ(kin.parents[1].group, 0U);
  EXPECT_EQ(kin.max_distance_mm, 2.5);
  EXPECT_EQ(kin.min_distance_mm, 0.4 * 2.5);

  const std::string written = effective_config(*config, folder_);
  const auto again = read(written);
  ASSERT_TRUE(again) << told() << written;
  EXPECT_EQ(effective_config(*again, folder_), written);
}

/// Tagged heads for a config whose groups leave some out.
const std::string kTagged =
    "schema: 1\ncrowd: {name: mob, count: 10}\n"
    "faces: {directory: heads, units: cm, tags: {ann: [old, female], bob: [old], cyd: [female]}}\n";

TEST_F(ConfigTest, GroupsLeaveOutHeadsWithATag) {
  const auto config =
      read(kTagged +
           "sampling: {targets: {ann: 1, cyd: 3}, bands: {skin: 8 mm}}\n"
           "groups:\n"
           "  - {name: women, share: 0.4, tags: [female], without: [old]}\n"
           "  - {name: not_old, share: 0.3, without: [old]}\n"
           "  - {name: men, sources: [ann, bob], targets: all, without: [female]}\n");
  ASSERT_TRUE(config) << told();
  const SamplingOptions& women = config->groups[0].sampling;
  EXPECT_THAT(women.sources, ElementsAre(2));
  ASSERT_EQ(women.targets.size(), 1U);
  EXPECT_EQ(women.targets[0].head, 2);
  const SamplingOptions& not_old = config->groups[1].sampling;
  EXPECT_THAT(not_old.sources, ElementsAre(2));
  ASSERT_EQ(not_old.targets.size(), 1U);
  EXPECT_EQ(not_old.targets[0].weight, 3) << "weights stay";
  const SamplingOptions& men = config->groups[2].sampling;
  EXPECT_THAT(men.sources, ElementsAre(1)) << "of named heads, too";
  ASSERT_EQ(men.targets.size(), 1U);
  EXPECT_EQ(men.targets[0].head, 1);

  const std::string written = effective_config(*config, folder_);
  const auto again = read(written);
  ASSERT_TRUE(again) << told() << written;
  EXPECT_EQ(effective_config(*again, folder_), written);
}

// Women got a third of their wrinkles from men.
TEST_F(ConfigTest, TagsOfAGroupBindItsAges) {
  const auto config = read(
      "schema: 1\ncrowd: {name: mob, count: 10}\n"
      "faces: {directory: heads, units: cm, tags: {ann: [old, female], bob: [old, male], "
      "cyd: [young, female]}}\n"
      "groups:\n"
      "  - {name: girls, tags: [female, young], age: 0.5}\n"
      "  - {name: others, without: [male, young]}\n"
      "  - {name: men, tags: [male]}\n");
  ASSERT_TRUE(config) << told();
  EXPECT_THAT(config->groups[0].sampling.heads_tagged_old, ElementsAre(0));
  EXPECT_THAT(config->groups[1].sampling.heads_tagged_old, ElementsAre(0));
  EXPECT_THAT(config->groups[1].sampling.heads_tagged_young, ElementsAre(2)) << "an age is no bond";
  EXPECT_THAT(config->groups[2].sampling.heads_tagged_young, ElementsAre(2)) << "no man is young";
}

// Eleven of thirty-three faces stood on heads of the other sex without a word.
TEST_F(ConfigTest, TagsOfAGroupBindTargetsThatHaveWeights) {
  const auto config = read(kTagged +
                           "groups:\n  - {name: women, tags: [female], targets: {old: 1, cyd: 3}}\n"
                           "  - {name: all, tags: [old], targets: all}\n");
  ASSERT_TRUE(config) << told();
  const auto& women = config->groups[0].sampling.targets;
  ASSERT_EQ(women.size(), 2U) << "bob is old, but not female";
  EXPECT_EQ(women[0].head, 0);
  EXPECT_EQ(women[1].head, 2);
  EXPECT_EQ(women[1].weight, 3);
  EXPECT_EQ(config->groups[1].sampling.targets.size(), 2U);
}

// Among the keys that bind faces to heads, tags and shares.
TEST_F(ConfigTest, KeysThatOtherKeysOverrideAreTold) {
  for (const char* file : {"hat.obj", "beard.obj"}) touch(file);
  touch("wardrobe/attachments.yaml",
        "attachments:\n  items: [{name: hat, kind: hat, file: ../hat.obj}, {name: full, kind: "
        "beard, file: ../beard.obj}]\n  none: {hat: 0.9, beard: 0.5}\n");
  const auto warnings = [&](const std::string& more, const std::string& config = kTagged) {
    const ConfigReading reading =
        read_partial_config(touch("c.yaml", config + more), {}, problems_);
    EXPECT_TRUE(reading.is_complete) << told();
    return reading.warnings;
  };
  const auto tells = [&](const std::string& more, const std::string& warning,
                         const std::string& config = kTagged) {
    EXPECT_THAT(warnings(more, config), ElementsAre(HasSubstr(warning))) << more;
  };
  const auto of_women = [](const std::string& group) {
    return "groups: [{name: women, count: 5, " + group + "}]\n";
  };
  const std::string kin = "families: [{name: kin, members: 2, group: women, age: 0}]\n";
  tells(of_women("tags: [female], sources: all"),
        "groups #1.sources: 1 of the 3 sources do not have the group's tags, female; 5 faces take "
        "detail from them");
  tells(of_women("tags: [female], sources: all") + kin, "7 faces take detail from them");
  tells("faces: {directory: heads, units: cm, tags: {cyd: [female], bob: [old]}}\n" +
            of_women("tags: [female], age: 0.5"),
        "groups #1.age: 1 of the 1 heads tagged old do not have the group's tags, female; 5 faces",
        "schema: 1\ncrowd: {name: mob, count: 10}\n");
  const std::string bands =
      "sampling: {bands: {build: 240 mm, skin: {smoothness: 8 mm, sources: "
      "[bob, cyd]}}}\n";
  tells(bands + of_women("tags: [female]"),
        "groups #1.bands.skin: 1 of the 2 sources do not have the group's tags, female; 5 faces");
  tells(
      "sampling: {targets: {bob: 2, cyd: 1}}\n" + of_women("tags: [female]"),
      "sampling.targets: does not apply to the group women, whose tags select its heads (5 faces)");
  tells("sampling: {sources: [bob]}\n" + of_women("tags: [female]"),
        "sampling.sources: does not apply to the group women");
  tells(of_women("targets: [ann, bob], without: [female]"),
        "groups #1.targets: without, female, leaves out ann (5 faces)");
  tells("groups: [{name: a, share: 1}, {name: b}]\n",
        "groups #2: the group b gets none of the 10 sampled faces");
  tells(of_women("tags: [female]") +
            "families: [{name: kin, members: 2, group: women, target: bob}]\n",
        "families #1.target: bob is not a target of the group women, but 2 faces");
  tells(of_women("age: [0.2, 0.5]") + "families: [{name: kin, members: 1, group: women}]\n",
        "families #1: the age of the group women does not apply to its members (1 face), whose "
        "age is 0; write age");
  tells("families: [{name: kin, members: 1, parents: {mother: drawn, father: drawn}}]\n",
        "families #1.parents.father: no target of sampling.targets is tagged male, so 1 face");
  tells("sampling: {age: 0.5}\nrecipes: [{id: mine, regions: {all: {weights: {cyd: 1}}}}]\n",
        "recipes #1: sampling.age moves the weights of mine to other heads (1 face)");
  tells("attachments: {items: [{name: hat, kind: hat, file: hat.obj}], hair_colours: {red: 0.5}}\n",
        "attachments.hair_colours: no attachment has a tint, so 10 faces");
  tells("attachments: {items: [{name: hat, kind: hat, file: hat.obj}]}\n" +
            of_women("hair_colours: {red: 0.5}"),
        "groups #1.hair_colours: no attachment has a tint, so 5 faces");
  tells(
      "attachments: {items: [{name: hat, kind: hat, file: hat.obj, tags: [old, female], without: "
      "[female]}]}\n",
      "attachments.items: hat: each head that has its tags also has a tag of without, female; no "
      "face wears it");
  tells("attachments: {from: wardrobe, quotas: {hat: 0.3}}\n",
        "attachments: none and quotas of the config replace the shares of the attachments' folder, "
        "also for beard (10 faces)");
  touch("heads/tags.yaml", "faces: {tags: {ann: [old], bob: [old]}}");
  EXPECT_THAT(warnings("", kPlain.substr(0, kPlain.size() - 2) + ", tags: {bob: [young]}}\n"),
              ElementsAre(HasSubstr("faces.tags: replaces tags.yaml beside the heads, so 1 of 3 "
                                    "heads lose their tags: ann")));

  EXPECT_THAT(warnings(of_women("tags: [female], sources: [ann]")), ElementsAre());
  EXPECT_THAT(warnings(of_women("sources: all")), ElementsAre());
  EXPECT_THAT(warnings(of_women("tags: [old], age: 0.5")), ElementsAre());
  EXPECT_THAT(warnings("attachments: {from: wardrobe, quotas: {hat: 0.3, beard: 0.2}}\n"),
              ElementsAre());
  EXPECT_THAT(warnings("sampling: {age: 0.5}\nrecipes: [{id: mine, age: 0, regions: {all: "
                       "{weights: {cyd: 1}}}}]\n"),
              ElementsAre());
  EXPECT_THAT(warnings("groups: [{name: a, share: 1}, {name: b, share: 0}]\n"), ElementsAre());
}

TEST_F(ConfigTest, GroupsWithoutAnybodyAreRefused) {
  const auto refused = [&](const std::string& group, const std::string& phrase) {
    EXPECT_FALSE(read(kTagged + "sampling: {bands: {build: {}, skin: 8 mm}}\ngroups: [{name: a, " +
                      group + "}]\n"))
        << group;
    EXPECT_THAT(told(), HasSubstr(phrase)) << group;
  };
  refused("without: [purple]", "no head has the tag \"purple\"");
  refused("tags: [old], without: [old]", "the group has no head left");
  refused("sources: [ann], without: [female]", "the group has no head left");
  refused("bands: {skin: {sources: [ann]}}, without: [old]", "the band skin has no source left");
  refused("tags: [female], targets: [ann, bob]", "\"bob\" does not have the group's tags, female");
  refused("targets: {bob: 2}, tags: [female]", "\"bob\" does not have the group's tags, female");
  EXPECT_FALSE(
      read("schema: 1\ncrowd: {name: mob, count: 10}\nfaces: {directory: heads, units: cm, "
           "tags: {ann: [female], bob: [male]}}\ngroups: [{name: a, tags: [female], targets: "
           "{female: 1, male: 1}}]\n"));
  EXPECT_THAT(told(), HasSubstr("no head tagged \"male\" has the group's tags, female"));
  refused("without: old", "a list of tags");
  refused("without: [not old]", "name");
}

// A brief says "an elderly woman with two daughters": nobody asks for the father.
TEST_F(ConfigTest, OneParentMayBeLeftOut) {
  const std::string tagged =
      "schema: 1\ncrowd: {name: mob, count: 3}\nfaces: {directory: heads, units: cm, tags: {ann: "
      "[female], bob: [male], cyd: [male]}}\n";
  const auto config = read(tagged +
                           "families:\n"
                           "  - {name: girls, members: 2, parents: {mother: drawn}}\n"
                           "  - {name: boys, members: 1, parents: {mother: mob_girls_mother}}\n"
                           "  - {name: kids, members: 1, parents: {father: bob}}\n");
  ASSERT_TRUE(config) << told();
  const auto parents = [](const Config& of, std::size_t family) {
    return std::pair(of.families[family].parents.at(0).id, of.families[family].parents.at(1).id);
  };
  EXPECT_EQ(parents(*config, 0).first, "girls_mother");
  EXPECT_THAT(parents(*config, 0).second, testing::AnyOf("bob", "cyd")) << "a head, tagged male";
  EXPECT_EQ(parents(*config, 1).second, parents(*config, 0).second) << "brothers of the girls";
  EXPECT_EQ(parents(*config, 2), (std::pair<std::string, std::string>("ann", "bob")));
  const auto again = read(effective_config(*config, folder_));
  ASSERT_TRUE(again) << told();
  EXPECT_EQ(parents(*again, 0), parents(*config, 0));
  EXPECT_FALSE(read(kPlain + "families: [{name: a, members: 1, parents: {}}]\n"));
  EXPECT_THAT(told(), HasSubstr("at least one of mother and father"));
  EXPECT_FALSE(read(kPlain + "families: [{name: a, members: 1, parents: {father: zed}}]\n"));
  EXPECT_THAT(told(), HasSubstr("found \"zed\""));
  const auto untagged =
      read(kPlain + "families: [{name: a, members: 1, parents: {father: bob}}]\n");
  ASSERT_TRUE(untagged) << told();
  EXPECT_NE(untagged->families[0].parents.at(0).head, untagged->families[0].parents.at(1).head);
}

TEST_F(ConfigTest, AgesMayBeInYears) {
  const auto with_ages = [](const std::string& ages) {
    return "schema: 1\ncrowd: {name: mob, count: 3}\nfaces: {directory: heads, units: cm, ages: {" +
           ages + "}}\n";
  };
  const std::string all = with_ages("ann: 18, bob: 70.5, cyd: 40");
  const auto config = read(all +
                           "sampling: {age: [30 years, 60 years]}\n"
                           "changes: {mob_0001: {age: 70years}}\n");
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->sampling->age, (AgeRange{{30, 60}, AgeUnit::kYears}));
  EXPECT_EQ(config->changes.at(0).age, (Age{70, AgeUnit::kYears}));
  EXPECT_THAT(config->faces.tags,
              ElementsAre(ElementsAre("young"), ElementsAre("old"), ElementsAre("adult")));
  EXPECT_THAT(config->sampling->heads_tagged_old, ElementsAre(1));
  const std::string written = effective_config(*config, folder_);
  const auto again = read(written);
  ASSERT_TRUE(again) << told() << written;
  EXPECT_EQ(effective_config(*again, folder_), written);
  EXPECT_EQ(again->sampling->age, config->sampling->age);
  EXPECT_EQ(again->faces.ages_years, config->faces.ages_years);

  const auto refused = [&](const std::string& text, const std::string& phrase) {
    EXPECT_FALSE(read(text)) << text;
    EXPECT_THAT(told(), HasSubstr(phrase)) << text;
  };
  refused(
      all + "sampling: {age: 8 years}\n",
      "expected an age from 18 to 70.5 years, the ages of the heads, found \"8 years\"; younger");
  refused(all + "changes: {mob_0001: {age: 71 years}}\n", "older faces");
  refused(all + "sampling: {age: [0.5, 60 years]}\n", "or years, such as");
  refused(all + "sampling: {age: [30 years, 0.5]}\n", "two ages in years");
  refused(all + "sampling: {age: 60}\n", "found \"60\"");
  refused(kPlain + "sampling: {age: 60 years}\n", "the age of the head ann is unknown");
  refused(with_ages("ann: 18") + "sampling: {age: 18 years}\n", "the age of the head bob");
  refused(with_ages("zed: 18"), "zed");
  refused(with_ages("ann: old"), "ann");
}

TEST_F(ConfigTest, AgesOfHeadsAreReadBesideTheHeads) {
  touch("heads/tags.yaml",
        "faces:\n  tags: {ann: [female, young]}\n  ages: {ann: 60, bob: 60, cyd: 30}\n");
  const auto config = read(kPlain);
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->faces.ages_years.at(2), 30);
  EXPECT_THAT(config->faces.tags.at(0), ElementsAre("female", "young")) << "an age tag counts";
  EXPECT_THAT(config->faces.tags.at(1), ElementsAre("old"));
  const auto own = read(
      "schema: 1\ncrowd: {name: mob, count: 3}\nfaces: {directory: heads, units: "
      "cm, ages: {ann: 20, bob: 30, cyd: 40}}\n");
  ASSERT_TRUE(own) << told();
  EXPECT_EQ(own->faces.ages_years.at(0), 20) << "the config's ages replace those of the file";
  EXPECT_THAT(own->faces.tags.at(0), ElementsAre("female", "young"));
}

// Six shares of 0.167 were refused, because they sum to 1.002.
TEST_F(ConfigTest, SharesThatAreRoundedUpAreScaled) {
  const auto scaled = [&](const std::vector<std::string>& shares) {
    std::string groups = kPlain + "groups:\n";
    for (std::size_t g = 0; g < shares.size(); ++g)
      groups += concat("  - {name: g", g, ", share: ", shares[g], "}\n");
    const auto config = read(groups);
    std::vector<double> result;
    for (std::size_t g = 0; config && g < shares.size(); ++g)
      result.push_back(config->groups[g].share);
    return result;
  };
  using testing::DoubleNear;
  using testing::Each;
  EXPECT_THAT(scaled(std::vector<std::string>(6, "0.167")), Each(DoubleNear(1.0 / 6, 1e-12)));
  EXPECT_THAT(scaled({"0.34", "0.34", "0.34"}), Each(DoubleNear(1.0 / 3, 1e-12)));
  EXPECT_THAT(scaled({"0.3", "0.7"}), ElementsAre(0.3, 0.7)) << "these need no scaling";
  EXPECT_THAT(scaled({"0.33", "0.33", "0.33"}), Each(0.33)) << "the others belong to no group";
  EXPECT_THAT(scaled({"0.5", "0.52"}), ElementsAre());
  EXPECT_THAT(scaled({"1", "0.02", "0"}), ElementsAre()) << "a share of 0 is not rounded";

  const auto colours = read(kPlain +
                            "attachments: {items: [], hair_colours: {red: 0.34, black: 0.34, "
                            "blond: 0.34}}\n");
  ASSERT_TRUE(colours) << told();
  EXPECT_NEAR(colours->attachments.hair_colours.at("red"), 1.0 / 3, 1e-12);
  const auto quotas =
      read(kPlain +
           "attachments: {items: [{name: a, kind: hair, file: heads/ann.obj}, {name: b, kind: "
           "hair, file: heads/ann.obj}, {name: c, kind: hair, file: heads/ann.obj}], quotas: {a: "
           "0.34, b: 0.34, c: 0.34}}\n");
  ASSERT_TRUE(quotas) << told();
  EXPECT_NEAR(quotas->attachments.quotas.at("b"), 1.0 / 3, 1e-12);
}

TEST_F(ConfigTest, SharesThatAreRoundedDownGiveAWarning) {
  const auto warnings = [&](const std::string& shares) {
    const std::string text =
        "schema: 1\ncrowd: {name: mob, count: 30}\nfaces: {directory: heads, units: cm}\ngroups: "
        "[" +
        shares + "]\n";
    const ConfigReading reading = read_partial_config(touch("c.yaml", text), {}, problems_);
    EXPECT_TRUE(reading.is_complete) << told();
    return reading.warnings;
  };
  EXPECT_THAT(warnings("{name: a, share: 0.33}, {name: b, share: 0.33}, {name: c, share: 0.33}"),
              ElementsAre(HasSubstr("sum to 0.99, so some faces may belong to no group")));
  EXPECT_THAT(warnings("{name: a, share: 0.33}, {name: b, share: 0.33}, {name: c}"), ElementsAre());
  EXPECT_THAT(warnings("{name: a, share: 0.6}, {name: b, share: 0.3}"), ElementsAre());
}

TEST_F(ConfigTest, GroupsThatCannotBeMeantAreRefused) {
  const auto refused = [&](const std::string& more, const std::string& phrase) {
    EXPECT_FALSE(read(kPlain + more)) << more;
    EXPECT_THAT(told(), HasSubstr(phrase)) << more;
  };
  refused("groups: [{share: 0.5}]\n", "name");
  refused("groups: [{name: a}, {name: a}]\n", "two groups are called \"a\"; rename one");
  refused("groups: [{name: a, share: 0.7}, {name: b, share: 0.7}]\n", "more than 1");
  refused("groups: [{name: a, share: 0.7, count: 1}]\n", "found both");
  refused("groups: [{name: a, count: 1000}]\n", "the counts sum to 1000");
  refused("groups: [{name: a, tags: [purple]}]\n", "these tags; no head has any tag");
  EXPECT_FALSE(read(kTagged + "groups: [{name: a, tags: [elderly]}]\n"));
  EXPECT_THAT(told(),
              HasSubstr("no head has all of these tags; the heads have the tags female, old"));
  refused(
      "groups: [{name: a}]\nfamilies: [{name: k, members: 1, parents: {mother: a, father: ann}}]\n",
      "\"a\" is a group; write {group: a}");
  refused("families: [{name: k, members: 1, group: nobody}]\n", "no group is called \"nobody\"");
}

/// Three bands over three regions.
const std::string kDetail =
    "sampling: {max_sources: 2, bands: {build: 240 mm, features: {smoothness: {default: 60 mm, "
    "top: "
    "[30 mm, 40 mm]}, extrapolation: [0.9, 1.1]}, skin: {smoothness: 8 mm, sources: [bob, cyd], "
    "position: {distribution: uniform}, ageing: 0.5}}}\n";

TEST_F(ConfigTest, BandsAreReadAndWritten) {
  std::ofstream(folder_ / "review.yaml")
      << "schema: 1\nfaces: {mob_0001: {lock: [top]}, mob_0002: {lock: [skin, mid/build]}}\n";
  const auto config = read(
      kBands + kDetail +
      "groups: [{name: worn, sources: [ann], bands: {skin: {sources: [cyd]}}}]\n"
      "recipes: [{id: mine, regions: {all: {weights: {ann: 1}, bands: {skin: {weights: {bob: 1}, "
      "iterations: 20}}}}}]\n"
      "families: [{name: kin, members: 1, parents: {mother: ann, father: bob}, inherit: {build: "
      "mother, low: father, low/skin: mother}}]\nreview: review.yaml\n");
  ASSERT_TRUE(config) << told();
  const SamplingOptions& sampling = *config->sampling;
  ASSERT_EQ(band_count(sampling), 3U);
  EXPECT_EQ(sampling.bands[0].name, "build");
  EXPECT_EQ(smoothness_of(sampling, 1, 0).range, (Range{240, 240}));
  EXPECT_EQ(smoothness_of(sampling, 0, 1).range, (Range{30, 40}));
  EXPECT_EQ(smoothness_of(sampling, 2, 1).range, (Range{60, 60}));
  EXPECT_EQ(sampling.bands[1].regions[2].extrapolation, (Range{0.9, 1.1}));
  EXPECT_FALSE(sampling.bands[1].regions[2].position);
  EXPECT_EQ(sampling.bands[2].regions[2].position->kind, PositionDistribution::Kind::kUniform);
  EXPECT_THAT(sources_of(sampling, 1), ElementsAre(0, 1, 2));
  EXPECT_THAT(sources_of(sampling, 2), ElementsAre(1, 2));
  EXPECT_EQ(sampling.bands[0].ageing, 0) << "the build does not age";
  EXPECT_EQ(sampling.bands[1].ageing, 1);
  EXPECT_EQ(sampling.bands[2].ageing, 0.5);
  EXPECT_THAT(sources_of(config->groups[0].sampling, 1), ElementsAre(0));
  EXPECT_THAT(sources_of(config->groups[0].sampling, 2), ElementsAre(2));
  EXPECT_EQ(config->groups[0].sampling.bands[2].ageing, 0.5);
  const ManualRecipe::Region& top = config->recipes[0].regions[0];
  EXPECT_EQ(top.weights[0].head, 0);
  ASSERT_EQ(top.bands.size(), 3U);
  EXPECT_TRUE(top.bands[0].weights.empty());
  EXPECT_EQ(top.bands[2].weights[0].head, 1);
  EXPECT_THAT(config->families[0].parent_of_band, ElementsAre(0, -1, -1, 0, -1, -1, 0, 1, 0));
  EXPECT_THAT(config->review.reviews[0].marks[0].locked_bands, ElementsAre(0, 1, 2));
  EXPECT_THAT(config->review.reviews[0].marks[1].locked_bands, ElementsAre(2, 3, 5, 8));

  const std::string written = effective_config(*config, folder_);
  const auto again = read(written);
  ASSERT_TRUE(again) << told() << written;
  EXPECT_EQ(effective_config(*again, folder_), written);
  EXPECT_EQ(again->families[0].parent_of_band, config->families[0].parent_of_band);
  EXPECT_THAT(sources_of(again->groups[0].sampling, 2), ElementsAre(2));
}

TEST_F(ConfigTest, QuotasAreRefusedWithTheGroupsThatReplaceThem) {
  EXPECT_TRUE(read(kBands + "diversity: {quotas: {}}\n")) << "as older crowds have it";
  struct Case {
    const char *config, *groups;
  };
  for (const auto& [config, groups] :
       {Case{"sampling: {targets: [ann, bob]}\ndiversity: {quotas: {ann: 0.25}}\n",
             "  - {name: ann, share: 0.25, targets: [ann]}\n  - {name: others, targets: [bob]}"},
        Case{"sampling: {targets: {ann: 2, bob: 1}}\ndiversity: {quotas: {ann: 0.5, bob: 0.5}}\n",
             "  - {name: ann, share: 0.5, targets: {ann: 2}}\n  - {name: bob, share: 0.5, targets: "
             "[bob]}"},
        Case{"sampling: {bands: {build: 240 mm, skin: {smoothness: 8 mm, sources: [bob, cyd]}}}\n"
             "diversity: {quotas: {bob: {share: 0.25, band: skin}, ann: 0.5}}\n",
             "  - {name: bob, share: 0.25, targets: [bob, cyd], bands: {skin: {sources: [bob]}}}\n"
             "  - {name: ann, share: 0.5, targets: [ann], bands: {skin: {sources: [cyd]}}}\n"
             "  - {name: others, targets: [bob, cyd], bands: {skin: {sources: [cyd]}}}"}}) {
    problems_ = Problems();
    EXPECT_FALSE(read(kBands + config)) << config;
    EXPECT_THAT(told(), HasSubstr(concat("add to the config:\ngroups:\n", groups)));
    const std::string rest(config, std::string_view(config).find("diversity"));
    problems_ = Problems();
    const auto pasted = read(concat(kBands, rest, "groups:\n", groups, "\n"));
    EXPECT_TRUE(pasted) << told();
  }
}

TEST_F(ConfigTest, MirroringIsReadAndWritten) {
  const auto config =
      read(kBands +
           "sampling: {asymmetry: [0.5, 1.2], mirror: drawn}\n"
           "groups: [{name: even, asymmetry: 0}, {name: as_scanned, asymmetry: 1, mirror: none}]\n"
           "recipes: [{id: mine, asymmetry: 0.3, mirrored: true}, {id: open}]\n");
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->sampling->asymmetry, (Range{0.5, 1.2}));
  EXPECT_EQ(config->sampling->mirror, Mirroring::kRandom);
  EXPECT_EQ(config->groups[0].sampling.asymmetry, (Range{0, 0}));
  EXPECT_EQ(config->groups[0].sampling.mirror, Mirroring::kRandom) << "as in sampling";
  EXPECT_FALSE(may_mirror(config->groups[1].sampling));
  EXPECT_EQ(config->recipes[0].asymmetry, (Range{0.3, 0.3}));
  EXPECT_EQ(config->recipes[0].mirrored, true);
  EXPECT_FALSE(config->recipes[1].asymmetry);
  const std::string written = effective_config(*config, folder_);
  const auto again = read(written);
  ASSERT_TRUE(again) << told() << written;
  EXPECT_EQ(effective_config(*again, folder_), written);
  EXPECT_FALSE(may_mirror(again->groups[1].sampling));
  const auto plain = read(kBands);
  ASSERT_TRUE(plain) << told();
  EXPECT_THAT(effective_config(*plain, folder_), Not(HasSubstr("mirror")))
      << "crowds of before stay as they are";
  for (const auto& [more, phrase] : {std::pair("sampling: {asymmetry: -1}\n", "from 0 to 4"),
                                     {"sampling: {mirror: all}\n", "none or drawn"},
                                     {"recipes: [{id: x, mirrored: 1}]\n", "true or false"}}) {
    problems_ = Problems();
    EXPECT_FALSE(read(std::string(kBands) + more)) << more;
    EXPECT_THAT(told(), HasSubstr(phrase)) << more;
  }
}

TEST_F(ConfigTest, BandsThatCannotBeMeantAreRefused) {
  const auto refused = [&](const std::string& more, const std::string& phrase) {
    problems_ = Problems();
    EXPECT_FALSE(read(kBands + more)) << more;
    EXPECT_THAT(told(), HasSubstr(phrase)) << more;
  };
  refused("sampling: {bands: 3}\n", "a mapping from bands to sizes");
  refused("sampling: {bands: {top: 8 mm}}\n", "\"top\" is a reserved word or the name of a region");
  refused("sampling: {bands: {a/b: 8 mm}}\n", "is not a valid name");
  refused("sampling: {bands: {build: {}, skin: {sources: all}}}\n", "smoothness: missing");
  refused("sampling: {bands: {skin: {smoothness: 900 mm}}}\n", "up to smoothing.max_size");
  refused("sampling: {bands: {skin: {smoothnes: 8 mm}}}\n", "did you mean \"smoothness\"");
  refused("sampling: {bands: {a: 0.9, b: 0.5, c: 0.3, d: 0.2, e: 0.1}}\n", "expected at most 4");
  refused("groups: [{name: g, bands: {skin: 8 mm}}]\n", "no band of sampling.bands is called");
  refused("recipes: [{id: a, regions: {all: {bands: {skin: {}}}}}]\n", "the config has no bands");
  refused(kDetail + "recipes: [{id: a, regions: {all: {bands: {skinn: {}}}}}]\n", "\"skin\"");
  refused(kDetail +
              "recipes: [{id: a, regions: {all: {bands: {skin: {weights: {ann: 1}, position: "
              "[0, 0]}}}}}]\n",
          "either position or weights");
  std::ofstream(folder_ / "review.yaml") << "schema: 1\nfaces: {mob_0001: {lock: [top/skn]}}\n";
  refused(kDetail + "review: review.yaml\n", "no region or band is called \"top/skn\"");
}

TEST_F(ConfigTest, CastingThatCannotBeMeantIsRefused) {
  const auto refused = [&](const std::string& more, const std::string& phrase) {
    problems_ = Problems();
    EXPECT_FALSE(read(kPlain + more)) << more;
    EXPECT_THAT(told(), HasSubstr(phrase)) << more;
  };
  refused("diversity: {min_distance: 2}\n", "expected a length with its unit");
  refused("diversity: {mode: best}\n", "first_fit or spread");
  refused("diversity: {max_weight: 0}\n", "above 0");
  refused("diversity: {candidates: 40}\n", "no longer has this key");
  refused("diversity: {max_attempts: 50}\n", "no longer has this key");
  refused("diversity: {quotas: {eve: 0.5}}\n", "groups have replaced quotas");
  refused("families: [{name: smith, members: 0, max_distance: 2 mm}]\n", "from 1 to 1000");
  refused("families: [{name: 7, members: 2, max_distance: 2 mm}]\n", "a family name with a letter");
  refused("families: [{name: a, members: 2, max_distance: 1 mm, min_distance: 3 mm}]\n",
          "at most twice max_distance");
  refused(
      "families: [{name: a, members: 2, max_distance: 1 mm, parents: {mother: a_01, father: "
      "bob}}]\n",
      "expected drawn, a head, a recipe's id or a member");
  refused("families: [{name: a, members: 2, max_distance: 1 mm, inherit: {all: mother}}]\n",
          "only in a family with parents");
  refused("sampling: {age: 0.5}\n", "no head has the tag old");
  refused("believability: {max_flipped: 2}\n", "from 0 to 1");
  refused("review: nowhere.yaml\n", "missing");
  touch("review.yaml");
  refused("review: review.yaml\n", "review.yaml:1:1");
}

TEST_F(ConfigTest, ReviewsAreReadAtTheirPlaces) {
  const auto file = folder_ / "review.yaml";
  std::ofstream(file) << "schema: 1\nfaces:\n  mob_0001: reject\n"
                         "  mob_0002: {lock: [top], note: 'a: b'}\n  mob_0003: keep\n";
  const auto config = read(kBands + "review: review.yaml\n");
  ASSERT_TRUE(config) << told();
  ASSERT_EQ(config->review.reviews.size(), 1U);
  const std::vector<ReviewMark>& review = config->review.reviews[0].marks;
  ASSERT_EQ(review.size(), 3U);
  EXPECT_EQ(review[0].verdict, ReviewMark::Verdict::kReject);
  EXPECT_EQ(review[1].verdict, ReviewMark::Verdict::kReject);
  EXPECT_THAT(review[1].locked_bands, ElementsAre(0U));
  EXPECT_EQ(review[1].note, "a: b");
  EXPECT_EQ(review[2].verdict, ReviewMark::Verdict::kKeep);
  std::ofstream(file) << "schema: 1\nfaces: {mob_0001: rejct, mob_0044: keep, mob_0002: {lock: "
                         "[tpo]}}\n";
  EXPECT_FALSE(read(kBands + "review: review.yaml\n"));
  EXPECT_THAT(told(), HasSubstr("review.yaml:2:"));
  EXPECT_THAT(told(), HasSubstr("did you mean \"reject\""));
  EXPECT_THAT(told(), HasSubstr("no face of this crowd is called \"mob_0044\""));
  EXPECT_THAT(told(), HasSubstr("no region is called \"tpo\""));
}

TEST_F(ConfigTest, LimitsOnMeasurementsAreReadAndWritten) {
  touch("census.csv",
        "trait,mean,standard deviation\r\nnose_width, 36, 2.5\r\n\"facial_index\",0.85,0.04\n");
  const auto config =
      read(kBands +
           "traits: {nose_width: {at_least: 3.6 cm}, eye_slope: [-2, 70 %], face_height: {}}\n"
           "population: census.csv\nquantiles_of: census.csv\n"
           "groups: [{name: g, share: 0.5, traits: {nose_width: [10 %, 30 %], nasal_index: [0.5, "
           "0.8]}}]\n"
           "recipes: [{id: lead, target: ann, traits: {mouth_width: {at_most: 50 mm}}}]\n"
           "families: [{name: kin, members: 2, traits: {intercanthal: {at_most: 30 %}}}]\n");
  ASSERT_TRUE(config) << told();
  const auto trait = [](const char* name) { return *find_measurement(name); };
  const TraitLimits crowd = {{trait("face_height")},
                             {trait("nose_width"), TraitBound{36, false}},
                             {trait("eye_slope"), TraitBound{-2, false}, TraitBound{0.7, true}}};
  EXPECT_EQ(config->sampling->traits, crowd);
  const TraitLimits group = {
      {trait("face_height")},
      {trait("nose_width"), TraitBound{0.1, true}, TraitBound{0.3, true}},
      {trait("eye_slope"), TraitBound{-2, false}, TraitBound{0.7, true}},
      {trait("nasal_index"), TraitBound{0.5, false}, TraitBound{0.8, false}}};
  EXPECT_EQ(config->groups.at(0).sampling.traits, group);
  EXPECT_EQ(config->recipes.at(0).traits.at(0).at_most, (TraitBound{50, false}));
  EXPECT_EQ(config->families.at(0).traits.at(0).at_most, (TraitBound{0.3, true}));
  const std::vector<TraitTarget> census = {{trait("nose_width"), 36, 2.5},
                                           {trait("facial_index"), 0.85, 0.04}};
  EXPECT_EQ(config->population.targets, census);
  EXPECT_EQ(config->quantile_table.targets, census);
  EXPECT_THAT(config->plan_names().traits,
              ElementsAre("face_height", "nose_width", "mouth_width", "intercanthal", "eye_slope",
                          "facial_index", "nasal_index"));
  const std::string written = effective_config(*config, folder_);
  const auto again = read(written);
  ASSERT_TRUE(again) << told();
  EXPECT_EQ(effective_config(*again, folder_), written);
}

TEST_F(ConfigTest, WrongLimitsOnMeasurementsAreRefused) {
  const auto refusal = [&](const std::string& more) {
    problems_ = Problems();
    EXPECT_FALSE(read(kBands + more)) << more;
    return told();
  };
  EXPECT_THAT(refusal("traits: {nose_widht: {}}\n"),
              HasSubstr("no measurement is called \"nose_widht\"; did you mean \"nose_width\"?"));
  EXPECT_THAT(refusal("traits: {nose_width: {at_least: 38}}\n"),
              HasSubstr("a length with its unit, such as \"38 mm\""));
  EXPECT_THAT(refusal("traits: {nose_width: [20 %, 101 %]}\n"),
              HasSubstr("a quantile from 0 % to 100 %"));
  EXPECT_THAT(refusal("traits: {eye_slope: {at_least: 3 mm}}\n"), HasSubstr("an angle in degrees"));
  EXPECT_THAT(refusal("traits: {nose_width: [40 mm, 30 mm]}\n"),
              HasSubstr("a least value that is at most the greatest"));
  EXPECT_THAT(refusal("traits: {nose_width: 38 mm}\n"), HasSubstr("{at_least: …, at_most: …}"));
  touch("census.csv", "nose_width,36,0\nnose,1,1\nmouth_width,50\n");
  const std::string told_of_census = refusal("population: census.csv\n");
  EXPECT_THAT(told_of_census, HasSubstr("census.csv:1: expected numbers"));
  EXPECT_THAT(told_of_census, HasSubstr("census.csv:2: no measurement is called \"nose\""));
  EXPECT_THAT(told_of_census, HasSubstr("census.csv:3: expected a measurement, its mean"));
  touch("census.csv", "nose_width,36,2\n");
  EXPECT_THAT(refusal("diversity: {mode: spread}\npopulation: census.csv\n"),
              HasSubstr("requires diversity.mode: first_fit"));
}

}  // namespace
}  // namespace crowdface
