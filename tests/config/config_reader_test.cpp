// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_reader.h"

#include <gmock/gmock.h>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/input_files.h"

#include "config/config_test_folder.h"

namespace crowdface {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ReadConfig : public ConfigTest {};

TEST_F(ReadConfig, DefaultsAreThoseOfTheReference) {
  const auto config = read(kPlain);
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->crowd.name, "mob");
  EXPECT_EQ(config->crowd.count, 3u);
  EXPECT_EQ(config->crowd.seed, 1u);
  EXPECT_THAT(config->faces.names, ElementsAre("ann", "bob", "cyd"));
  EXPECT_EQ(config->faces.files[1], folder_ / "heads/bob.obj");
  EXPECT_EQ(config->faces.units, LengthUnit::kCentimetre);
  EXPECT_EQ(config->faces.up, (Axis{1, 1}));
  EXPECT_EQ(config->faces.front, (Axis{2, 1}));
  EXPECT_EQ(config->faces.tags.size(), 3u);
  EXPECT_THAT(config->region_names(), ElementsAre("all"));
  EXPECT_EQ(config->smoothing.max_size_mm, 240);
  EXPECT_FALSE(config->smoothing.max_iterations);
  EXPECT_EQ(config->smoothing.levels, LevelRepresentation::kBasis);
  EXPECT_EQ(config->smoothing.tolerance_mm, 0.05);
  EXPECT_EQ(config->plane.layout, Layout::kCircle);
  ASSERT_EQ(config->sampling->regions.size(), 1u);
  EXPECT_EQ(config->sampling->regions[0].smoothness.range, (Range{0.2, 0.9}));
  EXPECT_EQ(config->sampling->regions[0].extrapolation, (Range{1, 1}));
  EXPECT_EQ(config->sampling->targets.size(), 3u);
  EXPECT_THAT(config->sampling->sources, ElementsAre(0, 1, 2));
  EXPECT_FALSE(config->sampling->max_sources);
  EXPECT_EQ(config->output.directory, folder_ / "out/mob");
  EXPECT_THAT(config->output.meshes, ElementsAre(MeshFormat::kObj));
  ASSERT_TRUE(config->output.contact_sheet);
  EXPECT_EQ(config->output.contact_sheet->columns, 6);
}

TEST_F(ReadConfig, HeadsAreSortedAndHiddenFilesAndFoldersLeftOut) {
  touch("heads/Zoe.OBJ");
  touch("heads/._ann.obj");
  touch("heads/notes.txt");
  touch("heads/old.obj/readme");
  const auto config = read(kPlain);
  ASSERT_TRUE(config) << told();
  EXPECT_THAT(config->faces.names, ElementsAre("Zoe", "ann", "bob", "cyd"));
}

// An array of weights was a head, and an array of four heads was one.
TEST_F(ReadConfig, FoldersSayWhichArraysAreNoHeads) {
  const auto write = [&](const std::string& name, const std::string& shape) {
    const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': " + shape + "}\n";
    touch(name,
          std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header);
  };
  for (const char* name : {"heads/faces.npy", "points/faces.npy"}) write(name, "(9, 3)");
  for (const char* name : {"points/ann.npy", "points/bob.npy"}) write(name, "(7, 3)");
  write("points/all.npy", "(4, 7, 3)");
  write("points/weights.npy", "(7,)");
  write("points/turned.npy", "(3, 7)");
  touch("points/scan.stl");
  EXPECT_THAT(left_out_meshes_message(folder_ / "heads"),
              ::testing::HasSubstr("left out is faces.npy (1)"));
  const std::string left_out =
      "left out are all.npy (it has 4 heads: save each head to its own "
      "file), scan.stl, weights.npy (an array of 7 is not a list of points) (3)";
  EXPECT_TRUE(left_out_meshes_message(folder_ / "points").ends_with(left_out))
      << left_out_meshes_message(folder_ / "points");
  std::string of_pattern;
  const auto heads = heads_matching(folder_ / "points" / "*", of_pattern);
  EXPECT_EQ(heads, list_heads(folder_ / "points"));
  EXPECT_EQ(names_of_heads(heads), (std::vector<std::string>{"ann", "bob", "turned"}));
  EXPECT_TRUE(of_pattern.ends_with(left_out)) << of_pattern;
}

TEST(NamesOfHeads, ReplacesCharactersThatNamesCannotHave) {
  EXPECT_EQ(names_of_heads({"Jörg Müller.obj", "head (1).OBJ", "头部 3.ply"}),
            (std::vector<std::string>{"Jorg_Muller", "head__1_", "___3"}));
  EXPECT_EQ(names_of_heads({"Ann B/neutral pose.obj", "Bob C/neutral pose.obj"}),
            (std::vector<std::string>{"Ann_B", "Bob_C"}));
}

TEST_F(ReadConfig, FilesKeepTheirOrder) {
  const auto config = read(
      "schema: 1\ncrowd: {name: a, count: 0}\n"
      "faces: {files: [heads/cyd.obj, heads/ann.obj], units: in, up: -z, front: X}\n");
  ASSERT_TRUE(config) << told();
  EXPECT_THAT(config->faces.names, ElementsAre("cyd", "ann"));
  EXPECT_EQ(config->faces.units, LengthUnit::kInch);
  EXPECT_EQ(config->faces.up, (Axis{2, -1}));
  EXPECT_EQ(config->faces.front, (Axis{0, 1}));
}

// Each asterisk multiplied the time by the length of the names.
TEST_F(ReadConfig, APatternMayHaveManyAsterisks) {
  touch("heads/" + std::string(200, 'a') + ".obj");
  std::string pattern;
  for (int i = 0; i < 50; ++i) pattern += "*a";
  const auto count = [&](const std::string& name) {
    return files_matching(folder_ / "heads" / name).size();
  };
  EXPECT_EQ(count(pattern + "*b.obj"), 0U);
  EXPECT_EQ(count(pattern + "*.obj"), 1U);
  EXPECT_EQ(count("*b.o?j"), 1U);
  EXPECT_EQ(count("?n*n.ob*j**"), 1U);
  EXPECT_EQ(count("*n"), 0U);
}

TEST_F(ReadConfig, RegionsTakeTheirOwnValuesOrTheDefault) {
  const auto config =
      read(kBands +
           "sampling:\n"
           "  position: {distribution: around, face: bob, radius: 0.5,\n"
           "             low: {distribution: fixed, position: [0.5, -1]}}\n"
           "  smoothness: {default: 0.5, top: [4 mm, 1.5cm], low: {iterations: [2, 9]}}\n"
           "  extrapolation: [0.9, 1.2]\n"
           "  max_sources: 2\n");
  ASSERT_TRUE(config) << told();
  const auto& regions = config->sampling->regions;
  ASSERT_EQ(regions.size(), 3u);
  EXPECT_EQ(regions[0].position.kind, PositionDistribution::Kind::kAround);
  EXPECT_EQ(regions[1].position.head, 1);
  EXPECT_EQ(regions[1].position.radius, 0.5);
  EXPECT_EQ(regions[2].position.at, PlanePoint(0.5, -1));
  EXPECT_EQ(regions[0].smoothness.unit, SmoothnessDistribution::Unit::kSize);
  EXPECT_EQ(regions[0].smoothness.range, (Range{4, 15}));
  EXPECT_EQ(regions[1].smoothness.range, (Range{0.5, 0.5}));
  EXPECT_EQ(regions[2].smoothness.unit, SmoothnessDistribution::Unit::kIterations);
  EXPECT_EQ(regions[2].smoothness.range, (Range{2, 9}));
  EXPECT_EQ(regions[2].extrapolation, (Range{0.9, 1.2}));
  EXPECT_EQ(config->sampling->max_sources, 2);
}

// The word `face` is a key of a position; a region may bear it, its values being mappings.
TEST_F(ReadConfig, ARegionMayBeCalledFace) {
  const auto config =
      read(kPlain +
           "regions: {names: [face, neck], mask: mask.png}\n"
           "sampling:\n"
           "  position: {distribution: around, radius: 1, face: {distribution: uniform}}\n");
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->sampling->regions[0].position.kind, PositionDistribution::Kind::kUniform);
  EXPECT_EQ(config->sampling->regions[1].position.kind, PositionDistribution::Kind::kAround);
}

TEST_F(ReadConfig, TargetsAndSourcesByNameTagAndWeight) {
  const std::string faces =
      "schema: 1\ncrowd: {name: a, count: 1}\n"
      "faces: {directory: heads/, units: m, tags: {ann: [old, thin], cyd: [old]}}\n";
  auto config = read(faces + "sampling: {targets: [old], sources: [bob, thin]}\n");
  ASSERT_TRUE(config) << told();
  ASSERT_EQ(config->sampling->targets.size(), 2u);
  EXPECT_EQ(config->sampling->targets[1].head, 2);
  EXPECT_THAT(config->sampling->sources, ElementsAre(0, 1));
  config = read(faces + "sampling: {targets: {old: 2, thin: 1, cyd: 0.5}}\n");
  ASSERT_TRUE(config) << told();
  ASSERT_EQ(config->sampling->targets.size(), 2u);
  EXPECT_EQ(config->sampling->targets[0].weight, 3) << "tags add up";
  EXPECT_EQ(config->sampling->targets[1].weight, 0.5) << "a head's own weight counts alone";
}

TEST_F(ReadConfig, RecipesByRegionAndForAll) {
  const auto config =
      read(kBands +
           "recipes:\n"
           "  - {id: aged, target: cyd, regions: {all: {weights: {bob: 1, ann: 0},\n"
           "     smoothness: 8 mm}, low: {position: [0, 1], iterations: 5,\n"
           "     extrapolation: [-1, 2]}}}\n"
           "  - id: free\n");
  ASSERT_TRUE(config) << told();
  ASSERT_EQ(config->recipes.size(), 2u);
  const ManualRecipe& aged = config->recipes[0];
  EXPECT_EQ(aged.target, 2);
  ASSERT_EQ(aged.regions.size(), 3u);
  ASSERT_EQ(aged.regions[1].weights.size(), 2u);
  EXPECT_EQ(aged.regions[1].weights[1].head, 1);
  EXPECT_EQ(aged.regions[1].smoothness->range.low, 8);
  EXPECT_TRUE(aged.regions[2].weights.empty()) << "a region's own entry stands alone";
  EXPECT_EQ(*aged.regions[2].position, PlanePoint(0, 1));
  EXPECT_EQ(aged.regions[2].smoothness->unit, SmoothnessDistribution::Unit::kIterations);
  EXPECT_EQ(*aged.regions[2].extrapolation, (Range{-1, 2}));
  EXPECT_FALSE(config->recipes[1].target);
  EXPECT_EQ(config->recipes[1].regions.size(), 3u);
}

TEST_F(ReadConfig, OutputAndPlane) {
  const auto config =
      read(kPlain +
           "plane: {layout: manual, anchors: {cyd: [1, 0], ann: [-.5, 2e0], bob: [0, 0]}}\n"
           "output: {directory: a/../b/, meshes: [], contact_sheet: none}\n");
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->plane.anchors.at(0), PlanePoint(-0.5, 2));
  EXPECT_EQ(config->output.directory, folder_ / "b");
  EXPECT_TRUE(config->output.meshes.empty());
  EXPECT_FALSE(config->output.contact_sheet);
}

TEST_F(ReadConfig, MasksMayBeTiles) {
  const auto config =
      read(kPlain + "regions: {names: [a, b, c, d], mask: [tiles.<UDIM>.png, mask.png]}\n");
  ASSERT_TRUE(config) << told();
  EXPECT_THAT(config->regions.mask, ElementsAre((folder_ / "tiles.<UDIM>.png").string(),
                                                (folder_ / "mask.png").string()));
}

TEST_F(ReadConfig, EveryProblemOfAFileIsToldInItsOrder) {
  EXPECT_FALSE(
      read("schema: 2\n"
           "crowd: {name: ../x, count: -1, sede: 3}\n"
           "faces: {directory: heads, unit: cm}\n"
           "smoothing: {operator: lasy, levels: base}\n"
           "sampling:\n"
           "  smoothness: 1.5\n"
           "  smoothness: 0.5\n"
           "outptu: {}\n"));
  EXPECT_EQ(
      told(),
      "c.yaml:1:9: schema: this crowdface reads schema 1, found \"2\"\n"
      "c.yaml:2:15: crowd.name: expected a name of 1 to 64 letters (a-z), digits, '_', '-' or '.', "
      "not starting with '.', found \"../x\"\n"
      "c.yaml:2:28: crowd.count: expected a whole number from 0 to 1000000, found \"-1\"\n"
      "c.yaml:2:32: unknown key \"sede\" in crowd; did you mean \"seed\"?\n"
      "c.yaml:3:8: faces.units: missing; write the unit of the files: mm, cm, m, in, ft, or a "
      "length\n"
      "c.yaml:3:27: unknown key \"unit\" in faces; did you mean \"units\"?\n"
      "c.yaml:4:23: smoothing.operator: expected umbrella or lazy, found \"lasy\"; did you mean "
      "\"lazy\"?\n"
      "c.yaml:4:37: smoothing.levels: expected basis or exact or cubic, found \"base\"; did you "
      "mean "
      "\"basis\"?\n"
      "c.yaml:6:15: sampling.smoothness: expected a number from 0 to 1, found \"1.5\"\n"
      "c.yaml:7:3: the key \"smoothness\" is used twice; first in line 6\n"
      "c.yaml:8:1: unknown key \"outptu\"; did you mean \"output\"?");
  EXPECT_EQ(problems_.code(), ExitCode::kUsage);
}

TEST_F(ReadConfig, MissingFilesAreMissingInput) {
  EXPECT_FALSE(
      read("schema: 1\ncrowd: {name: a, count: 1}\nfaces: {directory: nowhere, units: cm}\n"
           "regions: {names: [a], mask: no.png}\n"));
  EXPECT_THAT(told(), HasSubstr("c.yaml:3:20: faces.directory: the folder \"nowhere\""));
  EXPECT_THAT(told(), HasSubstr("c.yaml:4:29: regions.mask: the mask \"no.png\" is missing"));
  EXPECT_EQ(problems_.code(), ExitCode::kMissingInput);
  EXPECT_FALSE(
      read("schema: 1\ncrowd: {name: a, count: 1}\n"
           "faces: {files: [heads/ann.obj, heads/dan.obj], units: cm}\n"));
  EXPECT_EQ(told(), "c.yaml:3:32: faces.files #2: the file \"heads/dan.obj\" is missing");
  EXPECT_EQ(problems_.code(), ExitCode::kMissingInput);
  EXPECT_FALSE(read_config(folder_ / "none.yaml", {}, problems_));
  std::filesystem::create_symlink("gone.obj", folder_ / "heads/link.obj");
  EXPECT_FALSE(read(kPlain));
  EXPECT_THAT(told(), HasSubstr("link.obj\" is missing"));
}

TEST_F(ReadConfig, MessagesAboutMissingFilesNameTheCause) {
  const auto told_of = [&](const std::string& mask) {
    read(kPlain + "regions: {names: [a], mask: " + mask + "}\n");
    return told();
  };
  for (const char* name : {"masks/Kopf.png", "masks/e\u0301.png"}) touch(name, "x");
  EXPECT_THAT(told_of("masks/kopf.png"), HasSubstr("; did you mean \"Kopf.png\"?"));
  EXPECT_THAT(told_of("masks/\u00e9.png"), HasSubstr("accents are encoded in another way"));
  EXPECT_THAT(told_of("m.<udim>.png"), HasSubstr("write <UDIM> in capital letters"));
  EXPECT_THAT(told_of("masks\\Kopf.png"), HasSubstr("with / instead of \\"));
  EXPECT_THAT(told_of("masks"), HasSubstr("is a folder; name the file in it"));
}

TEST_F(ReadConfig, TooFewAndTooManyHeads) {
  touch("one/ann.obj");
  EXPECT_FALSE(read("schema: 1\ncrowd: {name: a, count: 1}\nfaces: {directory: one, units: cm}\n"));
  EXPECT_EQ(told(), "c.yaml:3:20: faces.directory: expected 2 to 50 heads, found 1 in \"one\"");
  for (int i = 0; i < 51; ++i) touch(concat("many/h", i, ".obj"));
  EXPECT_FALSE(
      read("schema: 1\ncrowd: {name: a, count: 1}\nfaces: {directory: many, units: cm}\n"));
  EXPECT_THAT(told(), HasSubstr("found 51"));
}

TEST_F(ReadConfig, HeadNamesMustBeUsable) {
  touch("heads/" + std::string(65, 'b') + ".obj");
  touch("heads/target.obj");
  touch("heads/ann.OBJ");
  EXPECT_FALSE(read(kPlain));
  EXPECT_THAT(told(), HasSubstr("the head's name, \"bbb"));
  EXPECT_THAT(told(), HasSubstr("a head cannot have the name \"target\""));
  EXPECT_THAT(told(), HasSubstr("two heads are called \"ann\""));
}

// Names that cannot be checked, because the heads were not found, are not held against the user.
TEST_F(ReadConfig, AWrongFolderIsOneProblem) {
  EXPECT_FALSE(read(
      "schema: 1\ncrowd: {name: a, count: 1}\n"
      "faces: {directory: nowhere, units: cm, tags: {ann: [old]}}\n"
      "plane: {layout: manual, anchors: {ann: [0, 0]}}\n"
      "sampling: {targets: [ann, old], position: {distribution: around, face: bob, radius: 1}}\n"
      "recipes: [{id: x, target: ann, regions: {all: {weights: {bob: 1}}}}]\n"));
  EXPECT_EQ(problems_.size(), 1u) << told();
}

TEST_F(ReadConfig, AWrongTagIsOneProblem) {
  EXPECT_FALSE(
      read("schema: 1\ncrowd: {name: a, count: 1}\n"
           "faces: {directory: heads, units: cm, tags: {amn: [old]}}\n"
           "sampling: {targets: [old], sources: {old: 1}}\n"
           "plane: {anchors: {bop: [0, 0]}}\n"));
  EXPECT_EQ(problems_.size(), 3u) << told();
  EXPECT_THAT(told(), HasSubstr("c.yaml:3:45: faces.tags: no head is called \"amn\""));
}

TEST_F(ReadConfig, TagsLieBesideTheHeads) {
  touch("heads/tags.yaml", "faces: {tags: {ann: [old], bob: [young], somebody: [old]}}");
  const auto config = read(kPlain);
  ASSERT_TRUE(config) << told();
  using Tags = std::vector<std::vector<std::string>>;
  EXPECT_EQ(config->faces.tags, (Tags{{"old"}, {"young"}, {}}));
  EXPECT_EQ(config->sampling->heads_tagged_old, (std::vector<Eigen::Index>{0}));
  const auto own = read(
      "schema: 1\ncrowd: {name: mob, count: 3}\n"
      "faces: {directory: heads, units: cm, tags: {cyd: [old]}}\n");
  ASSERT_TRUE(own) << told();
  EXPECT_EQ(own->faces.tags, (Tags{{}, {}, {"old"}}));
  touch("heads/tags.yaml", "faces: {tags: {ann: [all]}}");
  EXPECT_FALSE(read(kPlain));
  EXPECT_THAT(told(), HasSubstr("heads/tags.yaml:1:"));
  touch("heads/tags.yaml", "known better");
  EXPECT_FALSE(read(kPlain));
  EXPECT_THAT(told(), HasSubstr("heads/tags.yaml:1:1: expected faces.tags"));
}

TEST_F(ReadConfig, AttachmentsComeFromAFolder) {
  touch("heads/tags.yaml", "faces: {tags: {ann: [female], bob: [male]}}");
  touch("wardrobe/base.obj");
  for (const char* name : {"bob", "crop", "curls"}) touch(concat("wardrobe/", name, ".obj"));
  touch("cap.obj");
  const std::string list =
      "attachments:\n"
      "  fitted_to: base.obj\n"
      "  items:\n"
      "    - {name: bob, kind: hair, file: bob.obj, tags: [female], excludes: [curls]}\n"
      "    - {name: crop, kind: hair, file: crop.obj, tags: [male]}\n"
      "    - {name: curls, kind: wig, file: curls.obj, tags: [bald]}\n"
      "  none: {hair: 0.1, wig: 0.5}\n";
  touch("wardrobe/attachments.yaml", list);
  const auto config = read(kPlain + "attachments: {from: wardrobe}\n");
  ASSERT_TRUE(config) << told();
  const Config::Attachments& attachments = config->attachments;
  ASSERT_EQ(attachments.items.size(), 2u) << "nobody is bald";
  EXPECT_EQ(attachments.items[1].name, "crop");
  EXPECT_EQ(attachments.items[1].file, folder_ / "wardrobe/crop.obj");
  EXPECT_TRUE(attachments.items[0].excludes.empty());
  EXPECT_EQ(attachments.file, folder_ / "wardrobe/base.obj");
  EXPECT_EQ(attachments.fraction_without_item_by_kind,
            (std::map<std::string, double>{{"hair", 0.1}}));

  const auto more = read(kPlain +
                         "attachments:\n"
                         "  from: wardrobe\n"
                         "  fitted_to: ann\n"
                         "  items: [{name: cap, kind: hat, file: cap.obj}]\n"
                         "  quotas: {hair: 0.9}\n");
  ASSERT_TRUE(more) << told();
  EXPECT_EQ(more->attachments.items.size(), 3u);
  EXPECT_EQ(more->attachments.fitted_head, Eigen::Index{0});
  EXPECT_TRUE(more->attachments.file.empty());
  EXPECT_TRUE(more->attachments.fraction_without_item_by_kind.empty())
      << "the config's quotas replace them";
  EXPECT_EQ(more->attachments.quotas, (std::map<std::string, double>{{"hair", 0.9}}));

  const auto grouped = read(kPlain +
                            "attachments: {from: wardrobe, quotas: {bob: 0.5}}\n"
                            "groups: [{name: men, none: {hair: 0.3}}, {name: women}]\n");
  ASSERT_TRUE(grouped) << told();
  EXPECT_EQ(grouped->groups[0].fraction_without_item_by_kind,
            (std::map<std::string, double>{{"hair", 0.3}}));
  EXPECT_TRUE(grouped->groups[1].fraction_without_item_by_kind.empty());
  EXPECT_FALSE(read(kPlain + "attachments: {from: wardrobe}\n"
                             "groups: [{name: men, none: {hear: 0.3}}]\n"));
  EXPECT_THAT(told(), HasSubstr("no attachment is of the kind \"hear\""));
  EXPECT_FALSE(read(kPlain + "attachments: {from: wardrobe, quotas: {hair: 0.9}}\n"
                             "groups: [{name: men, none: {hair: 0.3}}]\n"));
  EXPECT_THAT(told(), HasSubstr("attachments.quotas also sets hair; keep only one of the two"));

  EXPECT_FALSE(read(kPlain + "attachments: {from: heads}\n"));
  EXPECT_THAT(told(), HasSubstr("c.yaml:4:21: attachments.from: the file"));
  touch("wardrobe/attachments.yaml", list + "  from: elsewhere\n");
  EXPECT_FALSE(read(kPlain + "attachments: {from: wardrobe}\n"));
  EXPECT_THAT(told(), HasSubstr("wardrobe/attachments.yaml:8:3: unknown key \"from\""));
}

TEST_F(ReadConfig, AFloodOfProblemsIsCut) {
  std::string text = kPlain + "sampling:\n";
  for (int i = 0; i < 5000; ++i) text += concat("  k", i, ": 1\n");
  EXPECT_FALSE(read(text));
  EXPECT_EQ(problems_.size(), 101u);
  EXPECT_THAT(problems_.messages().back(), HasSubstr("4900 more problems"));
}

TEST_F(ReadConfig, SetAndOptionsOverrideTheFile) {
  ConfigOverrides overrides;
  overrides.assignments = {"crowd.count=5", "crowd.count=6", "sampling.max_sources=2",
                           "output.contact_sheet={columns: 2}", "crowd.seed=8"};
  overrides.seed = "18446744073709551615";
  overrides.out = "elsewhere/";
  const auto config = read(kPlain, overrides);
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->crowd.count, 6u);
  EXPECT_EQ(config->crowd.seed, UINT64_MAX);
  EXPECT_EQ(config->sampling->max_sources, 2);
  EXPECT_EQ(config->output.contact_sheet->columns, 2);
  EXPECT_EQ(config->output.directory, "elsewhere") << "relative to the working directory";
}

TEST_F(ReadConfig, OverridesPassTheSameChecks) {
  ConfigOverrides overrides;
  overrides.assignments = {"crowd.cuont=5", "sampling.smoothness=[0.5, 0.1]", "plane.layout=circel",
                           "parts=automatic", "crowd.name="};
  overrides.count = "1e3";
  overrides.seed = "-1";
  overrides.out = "";
  EXPECT_FALSE(read(kPlain, overrides));
  EXPECT_THAT(told(), HasSubstr("--set crowd.cuont=5: unknown key \"cuont\" in crowd; did you mean "
                                "\"count\"?"));
  EXPECT_THAT(told(), HasSubstr("--set sampling.smoothness=[0.5, 0.1]: sampling.smoothness: "
                                "expected [low, high]"));
  EXPECT_THAT(told(), HasSubstr("did you mean \"circle\"?"));
  EXPECT_THAT(told(), HasSubstr("parts: expected auto or none, found \"automatic\""));
  EXPECT_THAT(told(), HasSubstr("--set crowd.name=: crowd.name: no value"));
  EXPECT_THAT(told(), HasSubstr("--count 1e3: crowd.count: expected a whole number"));
  EXPECT_THAT(told(), HasSubstr("--seed -1: crowd.seed: expected a whole number"));
  EXPECT_THAT(told(), HasSubstr("--out: expected a folder"));
}

TEST_F(ReadConfig, AnOverrideMendsABrokenValue) {
  ConfigOverrides overrides;
  overrides.count = "4";
  const auto config =
      read("schema: 1\ncrowd: {name: a, count: many}\nfaces: {directory: heads, units: cm}\n",
           overrides);
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->crowd.count, 4u);
}

}  // namespace
}  // namespace crowdface
