// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/config_reader.h"

#include <gmock/gmock.h>

#include "job/config_test_folder.h"

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
  EXPECT_EQ(config->smoothing.levels, Levels::kBasis);
  EXPECT_EQ(config->smoothing.tolerance_mm, 0.05);
  EXPECT_EQ(config->plane.layout, Layout::kCircle);
  ASSERT_EQ(config->sampling.regions.size(), 1u);
  EXPECT_EQ(config->sampling.regions[0].smoothness.range, (Range{0.2, 0.9}));
  EXPECT_EQ(config->sampling.regions[0].extrapolation, (Range{1, 1}));
  EXPECT_EQ(config->sampling.targets.size(), 3u);
  EXPECT_THAT(config->sampling.sources, ElementsAre(0, 1, 2));
  EXPECT_FALSE(config->sampling.max_sources);
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
  const auto& regions = config->sampling.regions;
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
  EXPECT_EQ(config->sampling.max_sources, 2);
}

// The word `face` is a key of a position; a region may bear it, its values being mappings.
TEST_F(ReadConfig, ARegionMayBeCalledFace) {
  const auto config =
      read(kPlain +
           "regions: {names: [face, neck], mask: mask.png}\n"
           "sampling:\n"
           "  position: {distribution: around, radius: 1, face: {distribution: uniform}}\n");
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->sampling.regions[0].position.kind, PositionDistribution::Kind::kUniform);
  EXPECT_EQ(config->sampling.regions[1].position.kind, PositionDistribution::Kind::kAround);
}

TEST_F(ReadConfig, TargetsAndSourcesByNameTagAndWeight) {
  const std::string faces =
      "schema: 1\ncrowd: {name: a, count: 1}\n"
      "faces: {directory: heads, units: m, tags: {ann: [old, thin], cyd: [old]}}\n";
  auto config = read(faces + "sampling: {targets: [old], sources: [bob, thin]}\n");
  ASSERT_TRUE(config) << told();
  ASSERT_EQ(config->sampling.targets.size(), 2u);
  EXPECT_EQ(config->sampling.targets[1].head, 2);
  EXPECT_THAT(config->sampling.sources, ElementsAre(0, 1));
  config = read(faces + "sampling: {targets: {old: 2, thin: 1, cyd: 0.5}}\n");
  ASSERT_TRUE(config) << told();
  ASSERT_EQ(config->sampling.targets.size(), 2u);
  EXPECT_EQ(config->sampling.targets[0].weight, 3) << "tags add up";
  EXPECT_EQ(config->sampling.targets[1].weight, 0.5) << "a head's own weight counts alone";
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
  const HandRecipe& aged = config->recipes[0];
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
      "c.yaml:3:8: faces.units: missing; what is one unit of the OBJ files: mm, cm, m or in?\n"
      "c.yaml:3:27: unknown key \"unit\" in faces; did you mean \"units\"?\n"
      "c.yaml:4:23: smoothing.operator: expected umbrella or lazy, found \"lasy\"; did you mean "
      "\"lazy\"?\n"
      "c.yaml:4:37: smoothing.levels: expected basis or exact or cubic, found \"base\"; did you "
      "mean "
      "\"basis\"?\n"
      "c.yaml:6:15: sampling.smoothness: expected a number from 0 to 1, found \"1.5\"\n"
      "c.yaml:7:3: the key \"smoothness\" stands here a second time; first in line 6\n"
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

TEST_F(ReadConfig, TooFewAndTooManyHeads) {
  touch("one/ann.obj");
  EXPECT_FALSE(read("schema: 1\ncrowd: {name: a, count: 1}\nfaces: {directory: one, units: cm}\n"));
  EXPECT_EQ(told(),
            "c.yaml:3:20: faces.directory: expected 2 to 50 heads, found 1 OBJ files in \"one\"");
  for (int i = 0; i < 51; ++i) touch(concat("many/h", i, ".obj"));
  EXPECT_FALSE(
      read("schema: 1\ncrowd: {name: a, count: 1}\nfaces: {directory: many, units: cm}\n"));
  EXPECT_THAT(told(), HasSubstr("found 51"));
}

TEST_F(ReadConfig, HeadNamesMustBeUsable) {
  touch("heads/a b.obj");
  touch("heads/target.obj");
  touch("heads/ann.OBJ");
  EXPECT_FALSE(read(kPlain));
  EXPECT_THAT(told(), HasSubstr("the head's name, \"a b\""));
  EXPECT_THAT(told(), HasSubstr("no head can be called \"target\""));
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

TEST_F(ReadConfig, AFloodOfProblemsIsCut) {
  std::string text = kPlain + "sampling:\n";
  for (int i = 0; i < 5000; ++i) text += concat("  k", i, ": 1\n");
  EXPECT_FALSE(read(text));
  EXPECT_EQ(problems_.size(), 101u);
  EXPECT_THAT(problems_.messages().back(), HasSubstr("4900 more problems"));
}

TEST_F(ReadConfig, SetAndOptionsOverrideTheFile) {
  ConfigOverrides overrides;
  overrides.set = {"crowd.count=5", "crowd.count=6", "sampling.max_sources=2",
                   "output.contact_sheet={columns: 2}", "crowd.seed=8"};
  overrides.seed = "18446744073709551615";
  overrides.out = "elsewhere/";
  const auto config = read(kPlain, overrides);
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->crowd.count, 6u);
  EXPECT_EQ(config->crowd.seed, UINT64_MAX);
  EXPECT_EQ(config->sampling.max_sources, 2);
  EXPECT_EQ(config->output.contact_sheet->columns, 2);
  EXPECT_EQ(config->output.directory, "elsewhere") << "relative to the working directory";
}

TEST_F(ReadConfig, OverridesPassTheSameChecks) {
  ConfigOverrides overrides;
  overrides.set = {"crowd.cuont=5", "sampling.smoothness=[0.5, 0.1]", "plane.layout=circel",
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

/// What is wrong with one value: the text that follows kBands (so it starts in line 5), the place,
/// a phrase of the message.
struct Wrong {
  const char* text;
  const char* place;
  const char* phrase;
};

/// Names a case in test lists; without it they would show addresses.
void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << wrong.text;
}

class WrongConfig : public ConfigTest, public testing::WithParamInterface<Wrong> {
 protected:
  void SetUp() override {
    ConfigTest::SetUp();
    std::filesystem::rename(folder_, folder_.parent_path() / flat_name());
    folder_ = folder_.parent_path() / flat_name();
  }

 private:
  // A parameterized test's name holds a slash.
  static std::string flat_name() {
    std::string name = concat("crowdface_wrong_", getpid(), '_',
                              testing::UnitTest::GetInstance()->current_test_info()->name());
    for (char& c : name) c = c == '/' ? '_' : c;
    return name;
  }
};

TEST_P(WrongConfig, IsToldOnceWithItsPlace) {
  EXPECT_FALSE(read(kBands + GetParam().text));
  EXPECT_THAT(told(), testing::StartsWith(concat("c.yaml:", GetParam().place, ": ")));
  EXPECT_THAT(told(), HasSubstr(GetParam().phrase));
  EXPECT_EQ(problems_.size(), 1u) << told();
  EXPECT_EQ(problems_.code(), ExitCode::kUsage);
}

INSTANTIATE_TEST_SUITE_P(
    Smoothing, WrongConfig,
    testing::Values(
        Wrong{"smoothing: {max_size: 240}", "5:23", "mm, cm, m or in?"},
        Wrong{"smoothing: {max_size: \"240\"}", "5:23", "length with its unit"},
        Wrong{"smoothing: {max_size: 240 ft}", "5:23", "found \"240 ft\""},
        Wrong{"smoothing: {max_size: 0 mm}", "5:23", "above 0 mm"},
        Wrong{"smoothing: {max_size: -5 mm}", "5:23", "from 0 mm to"},
        Wrong{"smoothing: {max_size: 11 m}", "5:23", "10000 mm"},
        Wrong{"smoothing: {max_size: 1e999 mm}", "5:23", "expected a length"},
        Wrong{"smoothing: {max_size: [1 mm]}", "5:23", "found a list of 1"},
        Wrong{"smoothing: {max_iterations: 0}", "5:29", "whole number from 1 to 10000000"},
        Wrong{"smoothing: {max_iterations: 1.5}", "5:29", "whole number"},
        Wrong{"smoothing: {max_iterations: 010}", "5:29", "ambiguous"},
        Wrong{"smoothing: {max_iterations: 0x10}", "5:29", "found \"0x10\""},
        Wrong{"smoothing: {max_iterations: 1_000}", "5:29", "found \"1_000\""},
        Wrong{"smoothing: {max_iterations: \"10\"}", "5:29", "leave the quotes out"},
        Wrong{"smoothing: {max_iterations: 99999999999999999999}", "5:29", "whole number"},
        Wrong{"smoothing: {boundary: fix}", "5:23", "did you mean \"fixed\"?"},
        Wrong{"smoothing: {operator: [lazy]}", "5:23", "found a list of 1"},
        Wrong{"smoothing: {levels: bases}", "5:21", "did you mean \"basis\"?"},
        Wrong{"smoothing: {tolerance: 0.05}", "5:24", "mm, cm, m or in?"},
        Wrong{"smoothing: {tolerance: 0.001 mm}", "5:24", "at least 0.005 mm"},
        Wrong{"smoothing: {tolerance: -1 mm}", "5:24", "expected a length"},
        Wrong{"smoothing: [max_size]", "5:12", "expected a mapping with the keys max_size"},
        Wrong{"smoothing:", "5:1", "no value"}, Wrong{"smoothing: ~", "5:1", "no value"},
        Wrong{"smoothing:\n  levels:\n", "6:3", "smoothing.levels: no value"}));

INSTANTIATE_TEST_SUITE_P(
    Basics, WrongConfig,
    testing::Values(
        Wrong{"parts: eyes", "5:8", "expected auto or none, found \"eyes\""},
        Wrong{"parts: {shape: targte}", "5:16", "did you mean \"target\"?"},
        Wrong{"parts: {rigid: Teeth}", "5:16", "expected a list of materials"},
        Wrong{"parts: {rigid: [[Teeth]]}", "5:17", "expected a material, a group"},
        Wrong{"parts: {together: [Teeth]}", "5:20", "expected a list of materials"},
        Wrong{"parts: {soft: []}", "5:9", "expected one of shape, skin, rigid"},
        Wrong{"blending: {normalization: print}", "5:27", "did you mean \"printed\"?"},
        Wrong{"blending: {normalisation: printed}", "5:12", "did you mean \"normalization\"?"},
        Wrong{"plane: {layout: manual, anchors: {ann: [0, 0]}}", "5:17",
              "missing in plane.anchors: "
              "bob, cyd"},
        Wrong{"plane: {layout: manual}", "5:17", "ann, bob, cyd"},
        Wrong{"plane: {anchors: {anna: [0, 0]}}", "5:19", "did you mean \"ann\"?"},
        Wrong{"plane: {anchors: {ann: 3}}", "5:24",
              "expected a list of two numbers, [x, y], found "
              "\"3\""},
        Wrong{"plane: {anchors: {ann: {x: 1}}}", "5:24", "found a mapping"},
        Wrong{"plane: {anchors: {ann: [0, 0, 0]}}", "5:24", "found a list of 3"},
        Wrong{"plane: {anchors: {ann: [0, nan]}}", "5:28", "plane.anchors.ann #2"},
        Wrong{"plane: {anchors: {ann: [.inf, 0]}}", "5:25", "expected a number"},
        Wrong{"plane: {anchors: {ann: [0, 2e6]}}", "5:28", "found \"2e6\""},
        Wrong{"plane: {anchors: {ann: [0, 1e999]}}", "5:28", "found \"1e999\""},
        Wrong{"plane: {anchors: [1]}", "5:18", "mapping from heads to points"},
        Wrong{"output: {meshes: obj}", "5:18", "expected a list"},
        Wrong{"output: {meshes: [obj, obj]}", "5:24", "twice"},
        Wrong{"output: {meshes: [fbx]}", "5:19",
              "expected obj or ply or glb or points, found \"fbx\""},
        Wrong{"output: {directory: ''}", "5:21", "expected a folder"},
        Wrong{"output: {directory: \"a\\0b\"}", "5:21", "expected a folder"},
        Wrong{"output: {contact_sheet: off}", "5:25", "none or a mapping"},
        Wrong{"output: {contact_sheet: {labels: [id, id]}}", "5:39", "named twice"},
        Wrong{"output: {contact_sheet: {labels: []}}", "5:34", "a list of labels"},
        Wrong{"output: {contact_sheet: {order: size}}", "5:33", "likeness"},
        Wrong{"output: {contact_sheet: {compare_scale: 0 mm}}", "5:41", "above 0"},
        Wrong{"output: {meshes: [], contact_sheet: {compare: target}}", "5:47", "needs meshes"},
        Wrong{"output: {gallery: yes}", "5:19", "auto"},
        Wrong{"output: {surfaces: {Skin: '#12345'}}", "5:27", "#c0a080"},
        Wrong{"output: {surfaces: {Skin: stone}}", "5:27", "hidden"},
        Wrong{"output: {contact_sheet: {columns: 33}}", "5:35", "from 1 to 32"},
        Wrong{"output: {contact_sheet: {rows: 0}}", "5:32", "from 1 to 64"},
        Wrong{"output: {contact_sheet: {cell: 31}}", "5:32", "from 32 to 2048"},
        Wrong{"output: {contact_sheet: {views: []}}", "5:33", "an empty list"},
        Wrong{"output: {contact_sheet: {views: [top]}}", "5:34", "found \"top\""},
        Wrong{"output: {contact_sheet: {views: [front, front]}}", "5:41", "twice"}));

INSTANTIATE_TEST_SUITE_P(
    Sampling, WrongConfig,
    testing::Values(
        Wrong{"sampling: {targets: ann}", "5:21", "all or a list of heads and tags"},
        Wrong{"sampling: {targets: []}", "5:21", "an empty list"},
        Wrong{"sampling: {targets: {}}", "5:21", "an empty mapping"},
        Wrong{"sampling: {targets: [bop]}", "5:22", "did you mean \"bob\"?"},
        Wrong{"sampling: {targets: {ann: 0}}", "5:27", "above 0"},
        Wrong{"sampling: {targets: {ann: -1}}", "5:27", "from 0 to"},
        Wrong{"sampling: {targets: {ann: ~}}", "5:22", "found no value"},
        Wrong{"sampling: {sources: {ann: 1}}", "5:21", "found a mapping"},
        Wrong{"sampling: {sources: [ann, nobody]}", "5:27", "no head and no tag"},
        Wrong{"sampling: {max_sources: 0}", "5:25", "from 1 to 50"},
        Wrong{"sampling: {max_source: 2}", "5:12", "did you mean \"max_sources\"?"},
        Wrong{"sampling: {smoothness: 2}", "5:24", "from 0 to 1"},
        Wrong{"sampling: {smoothness: 00.5}", "5:24", "write 0.5"},
        Wrong{"sampling: {smoothness: '0.5'}", "5:24", "leave the quotes out"},
        Wrong{"sampling: {smoothness: much}", "5:24", "a fraction from 0 to 1 or a size"},
        Wrong{"sampling: {smoothness: [0.5, 0.2]}", "5:24", "\"0.5\" before \"0.2\""},
        Wrong{"sampling: {smoothness: [0.5]}", "5:24", "a list of two"},
        Wrong{"sampling: {smoothness: [0.5, 8 mm]}", "5:24", "one of each"},
        Wrong{"sampling: {smoothness: 300 mm}", "5:24", "up to smoothing.max_size, 240 mm"},
        Wrong{"sampling: {smoothness: {}}", "5:24", "an empty mapping"},
        Wrong{"sampling: {smoothness: {tpo: 0.5}}", "5:25", "did you mean \"top\"?"},
        Wrong{"sampling: {smoothness: {top: ~}}", "5:25", "no value"},
        Wrong{"sampling: {smoothness: {default: 0.5, iterations: 3}}", "5:24", "not both"},
        Wrong{"sampling: {smoothness: {iterations: 0.5}}", "5:37", "whole number"},
        Wrong{"smoothing: {max_iterations: 9}\nsampling: {smoothness: {iterations: 10}}", "6:37",
              "from 0 to 9"},
        Wrong{"sampling: {extrapolation: 5}", "5:27", "from -4 to 4"},
        Wrong{"sampling: {extrapolation: {top: {low: 1}}}", "5:33", "found a mapping"},
        Wrong{"sampling: {extrapolation: {top: [1, 2, 3]}}", "5:33", "[low, high]"},
        Wrong{"sampling: {position: uniform}", "5:22", "expected a mapping"},
        Wrong{"sampling: {position: {distribution: unifrom}}", "5:37", "did you mean \"uniform\"?"},
        Wrong{"sampling: {position: {radius: 1}}", "5:22",
              "sampling.position.distribution: missing"},
        Wrong{"sampling: {position: {distribution: uniform, radius: 1}}", "5:46", "has no radius"},
        Wrong{"sampling: {position: {distribution: around}}", "5:22", "radius: missing"},
        Wrong{"sampling: {position: {distribution: around, radius: 0}}", "5:53", "above 0"},
        Wrong{"sampling: {position: {distribution: around, radius: 1, face: eve}}", "5:62",
              "no head is called \"eve\""},
        Wrong{"sampling: {position: {distribution: fixed}}", "5:22", "position: missing"},
        Wrong{"sampling: {position: {low: {distribution: fixed, position: [1]}}}", "5:60",
              "list of two numbers"}));

INSTANTIATE_TEST_SUITE_P(
    Recipes, WrongConfig,
    testing::Values(
        Wrong{"recipes: {id: a}", "5:10", "expected a list of recipes"},
        Wrong{"recipes: [a]", "5:11", "expected a mapping with the keys id"},
        Wrong{"recipes: [{target: ann}]", "5:11", "recipes #1.id: missing"},
        Wrong{"recipes: [{id: a/b}]", "5:16", "expected a name"},
        Wrong{"recipes: [{id: .a}]", "5:16", "not starting with '.'"},
        Wrong{"recipes: [{id: mob_0004}]", "5:16", "belong to the sampled faces"},
        Wrong{"recipes: [{id: a}, {id: a}]", "5:25", "second time; first at"},
        Wrong{"recipes: [{id: a, target: dan}]", "5:27", "no head is called \"dan\""},
        Wrong{"recipes: [{id: a, regions: {topp: {}}}]", "5:29", "did you mean \"top\"?"},
        Wrong{"recipes: [{id: a, regions: {top: 3}}]", "5:34", "found \"3\""},
        Wrong{"recipes: [{id: a, regions: {top: {weigths: {}}}}]", "5:35", "\"weights\"?"},
        Wrong{"recipes: [{id: a, regions: {top: {weights: {}}}}]", "5:44", "an empty mapping"},
        Wrong{"recipes: [{id: a, regions: {top: {weights: {ann: -1}}}}]", "5:50", "from 0 to"},
        Wrong{"recipes: [{id: a, regions: {top: {weights: {ann: 0, bob: 0}}}}]", "5:44",
              "sum to zero"},
        Wrong{"recipes: [{id: a, regions: {top: {weights: {ann: 1}, position: [0, 0]}}}]", "5:34",
              "either position or weights"},
        Wrong{"recipes: [{id: a, regions: {top: {smoothness: 0.5, iterations: 3}}}]", "5:34",
              "either smoothness or iterations"},
        Wrong{"recipes: [{id: a, regions: {top: {smoothness: {iterations: 3}}}}]", "5:47",
              "found a mapping"},
        Wrong{"blending: {normalization: printed}\n"
              "recipes: [{id: a, regions: {all: {weights: {ann: 1}}}}]",
              "6:44", "takes positions, no weights"}));

// Every key that takes a plain value, with every kind of wrong value in place of it.
TEST_F(ReadConfig, NoKeyTakesAValueOfAnotherKind) {
  const std::vector<std::string> keys = {
      "smoothing: {max_size: ",
      "smoothing: {max_iterations: ",
      "smoothing: {boundary: ",
      "smoothing: {operator: ",
      "smoothing: {levels: ",
      "smoothing: {tolerance: ",
      "blending: {normalization: ",
      "plane: {layout: ",
      "plane: {anchors: {bob: ",
      "sampling: {targets: ",
      "sampling: {targets: {bob: ",
      "sampling: {sources: ",
      "sampling: {max_sources: ",
      "sampling: {position: ",
      "sampling: {position: {distribution: ",
      "sampling: {position: {top: ",
      "sampling: {position: {default: {distribution: around, radius: ",
      "sampling: {position: {default: {distribution: around, radius: 1, face: ",
      "sampling: {position: {default: {distribution: fixed, position: ",
      "sampling: {smoothness: ",
      "sampling: {smoothness: {mid: ",
      "sampling: {smoothness: {iterations: ",
      "sampling: {extrapolation: {low: [0, ",
      "recipes: [{id: a, target: ",
      "recipes: [{id: a, regions: {all: {position: ",
      "recipes: [{id: a, regions: {all: {weights: ",
      "recipes: [{id: a, regions: {all: {weights: {bob: ",
      "recipes: [{id: a, regions: {all: {smoothness: ",
      "recipes: [{id: a, regions: {all: {iterations: ",
      "output: {contact_sheet: {columns: ",
      "output: {contact_sheet: {rows: ",
      "output: {contact_sheet: {cell: ",
      "output: {contact_sheet: {views: ",
  };
  for (const std::string& key : keys) {
    std::string closing;
    for (auto c = key.rbegin(); c != key.rend(); ++c) {
      if (*c == '{') closing += '}';
      if (*c == '[') closing += ']';
    }
    for (const char* value : {"[]", "{}", "[[1], 2]", "{x: 1}", "nonsense", "-7", "nan", ".inf",
                              "''", "1e999", "0x1F"}) {
      const std::string text = key + value + closing;
      EXPECT_FALSE(read(kBands + text)) << text;
      ASSERT_FALSE(problems_.empty()) << text;
      EXPECT_THAT(told(), testing::StartsWith("c.yaml:5:")) << text;
      EXPECT_EQ(problems_.code(), ExitCode::kUsage) << text;
      const auto column = parse_unsigned(told().substr(9, told().find(':', 9) - 9));
      ASSERT_TRUE(column) << told();
      EXPECT_GE(*column, key.size() + 1) << text << '\n' << told();
    }
  }
}

class WrongHead : public ConfigTest {};

TEST_F(WrongHead, SectionsAreCheckedToo) {
  const auto first = [&](const std::string& text) {
    EXPECT_FALSE(read(text)) << text;
    return problems_.empty() ? "" : told();
  };
  const std::string schema = "schema: 1\n", crowd = "crowd: {name: a, count: 1}\n";
  EXPECT_THAT(first(""), HasSubstr("c.yaml:1:1: expected a value, found nothing"));
  EXPECT_THAT(first("- a\n"), HasSubstr("c.yaml:1:1: expected a mapping with the keys schema"));
  EXPECT_THAT(first("a:b\n"), HasSubstr("found \"a:b\""));
  EXPECT_THAT(first("{}\n"), HasSubstr("c.yaml:1:1: schema: missing; write \"schema: 1\"\n"
                                       "c.yaml:1:1: crowd: missing"));
  EXPECT_THAT(first("schema: '1'\n"),
              HasSubstr("c.yaml:1:9: schema: this crowdface reads schema 1"));
  const auto with_faces = [&](const std::string& faces) {
    return first(schema + crowd + "faces: " + faces + "\n");
  };
  EXPECT_THAT(with_faces("{units: cm}"), HasSubstr("3:8: faces: directory or files is missing"));
  EXPECT_THAT(with_faces("{units: cm, directory: a, files: [b.obj]}"), HasSubstr("not both"));
  EXPECT_THAT(with_faces("{units: cm, files: heads/ann.obj}"),
              HasSubstr("3:27: faces.files: expected a list"));
  EXPECT_THAT(with_faces("{units: cm, files: [heads/ann.obj]}"), HasSubstr("found 1 files"));
  EXPECT_THAT(with_faces("{units: cm, files: [a.fbx, b.obj]}"), HasSubstr("ends in .obj"));
  EXPECT_THAT(with_faces("{units: feet, directory: heads}"),
              HasSubstr("3:16: faces.units: expected mm or cm or m or in"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, up: W}"),
              HasSubstr("3:42: faces.up: expected an axis"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, up: +Z}"), HasSubstr("two different axes"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, align: rigdi}"),
              HasSubstr("did you mean \"rigid\"?"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {amn: [x]}}"),
              HasSubstr("3:45: faces.tags: no head is called \"amn\"; did you mean \"ann\"?"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {ann: [bob]}}"),
              HasSubstr("also the name of a head"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {ann: [x, x]}}"),
              HasSubstr("3:54: faces.tags.ann #2: the tag \"x\" is named twice"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {ann: [all]}}"),
              HasSubstr("no tag can be called"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {ann: old}}"),
              HasSubstr("a list of tags"));
  const auto with_regions = [&](const std::string& regions) {
    return first(kPlain + "regions: " + regions + "\n");
  };
  EXPECT_THAT(with_regions("some"), HasSubstr("4:10: regions: expected none or a mapping"));
  EXPECT_THAT(with_regions("{names: [a]}"), HasSubstr("regions.mask: missing"));
  EXPECT_THAT(with_regions("{mask: mask.png}"), HasSubstr("regions.names: missing"));
  EXPECT_THAT(with_regions("{names: a, mask: mask.png}"), HasSubstr("a list of 1 to 16 names"));
  EXPECT_THAT(with_regions("{names: [default], mask: mask.png}"),
              HasSubstr("no region can be called \"default\""));
  EXPECT_THAT(with_regions("{names: [a, a], mask: mask.png}"),
              HasSubstr("4:22: regions.names #2: the region \"a\" is named twice"));
  EXPECT_THAT(with_regions("{names: [a], mask: []}"), HasSubstr("an image file or a list"));
  EXPECT_THAT(with_regions("{names: [a], mask: \"<UDIM>/a.png\"}"),
              HasSubstr("<UDIM> can stand once"));
  EXPECT_THAT(with_regions("{names: [a], mask: no.<UDIM>.png}"), HasSubstr("no tile of the mask"));
}

TEST_F(ConfigTest, CastingIsRead) {
  const auto config =
      read(kBands +
           "diversity: {mode: spread, min_distance: 1.5 mm, min_distance_to_faces: "
           "1 mm, max_weight: 0.7, quotas: {ann: 0.25}, candidates: 4, pool: 20, "
           "max_attempts: 50}\n"
           "distance: {area: skin}\n"
           "believability: {max_deviation: 2, max_stretch: 4, max_flipped: 0.01, "
           "max_intersecting: 0.02, meshes: none}\n"
           "families:\n"
           "  - {name: smith, members: 2, target: bob, max_distance: 2 mm}\n"
           "  - {name: jones, members: 3, parents: {mother: ann, father: smith_02}, "
           "max_distance: 2 mm, min_distance: 0.5 mm}\n");
  ASSERT_TRUE(config) << told();
  EXPECT_EQ(config->diversity.mode, DiversityOptions::Mode::kSpread);
  EXPECT_EQ(config->diversity.min_distance_mm, 1.5);
  EXPECT_EQ(config->diversity.min_distance_to_faces_mm, 1);
  EXPECT_EQ(config->diversity.max_weight, 0.7);
  ASSERT_EQ(config->diversity.quotas.size(), 1U);
  EXPECT_THAT(config->diversity.quotas[0].heads, ElementsAre(0));
  EXPECT_EQ(config->diversity.candidates, 4);
  EXPECT_EQ(config->diversity.pool, 20);
  EXPECT_EQ(config->diversity.max_attempts, 50);
  EXPECT_EQ(config->distance.area, FaceArea::kSkin);
  EXPECT_EQ(config->believability.max_stretch, 4);
  EXPECT_EQ(config->believability.meshes, BelievabilityOptions::Meshes::kNone);
  ASSERT_EQ(config->families.size(), 2U);
  EXPECT_EQ(config->families[0].target, 1);
  EXPECT_EQ(config->families[1].parents[0].head, 0);
  EXPECT_EQ(config->families[1].parents[1].id, "smith_02");
  EXPECT_EQ(config->families[1].min_distance_mm, 0.5);
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
  refused("diversity: {quotas: {eve: 0.5}}\n", "\"eve\"");
  refused("diversity: {quotas: {ann: 0.7, bob: 0.4}}\n", "at most 1");
  refused("diversity: {quotas: {ann: 0.2, bob: 0.2, cyd: 0.2}}\n", "for whom is the rest");
  refused("sampling: {targets: [ann]}\ndiversity: {quotas: {bob: 0.5}}\n", "sampling.targets");
  refused("families: [{name: smith, members: 0, max_distance: 2 mm}]\n", "from 1 to 1000");
  refused("families: [{name: smith, members: 2}]\n", "max_distance: missing");
  refused("families: [{name: 7, members: 2, max_distance: 2 mm}]\n", "needs a letter");
  refused("families: [{name: a, members: 2, max_distance: 1 mm, min_distance: 3 mm}]\n",
          "twice that apart");
  refused(
      "families: [{name: a, members: 2, max_distance: 1 mm, parents: {mother: a_01, father: "
      "bob}}]\n",
      "expected a head, a recipe's id or a member");
  refused("families: [{name: a, members: 2, max_distance: 1 mm, inherit: {all: mother}}]\n",
          "only a family with parents");
  refused("sampling: {age: 0.5}\n", "no head is tagged old");
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
  const Review& review = config->review.reviews[0];
  ASSERT_EQ(review.size(), 3U);
  EXPECT_EQ(review[0].verdict, ReviewMark::Verdict::kReject);
  EXPECT_EQ(review[1].verdict, ReviewMark::Verdict::kReject);
  EXPECT_THAT(review[1].locked, ElementsAre(0U));
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

}  // namespace
}  // namespace crowdface
