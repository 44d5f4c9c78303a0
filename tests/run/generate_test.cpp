// SPDX-License-Identifier: Apache-2.0
// The whole job against the plain computation, and what must not change its bytes.
#include "crowdface/run/generate.h"

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/run/crowd_sheets.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::crowd_files;
using testing::differing_files;
using testing::plan_lines;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

void expect_crowd_is_right(const SmallCrowd& crowd) {
  const SmallCrowdFolder folder(crowd);
  run(folder);
  EXPECT_EQ(plan_lines(folder.out()).size(), static_cast<std::size_t>(crowd.count));
  testing::expect_meshes_match_plan(folder, folder.out());
  testing::expect_weights_match_positions(folder, folder.out());
}

TEST(Generate, MatchesThePlainMethod) {
  for (const char* boundary : {"fixed", "free"}) {
    for (const char* operator_kind : {"umbrella", "lazy"}) {
      for (const char* normalization : {"partition", "printed"}) {
        for (const std::size_t regions : {0U, 3U, 5U}) {
          SCOPED_TRACE(concat(boundary, ' ', operator_kind, ' ', normalization, ' ', regions));
          SmallCrowd crowd;
          crowd.boundary = boundary;
          crowd.operator_kind = operator_kind;
          crowd.normalization = normalization;
          crowd.regions = regions;
          crowd.alpha = regions == 5;
          crowd.bowl.normals = regions == 3;
          crowd.bowl.crlf = regions == 0;
          crowd.count = 3;
          expect_crowd_is_right(crowd);
        }
      }
    }
  }
}

TEST(Generate, MeshesNameTheMaterialFileThatWasFoundForAPathOfAnotherMachine) {
  SmallCrowd crowd;
  crowd.bowl.materials = true;
  crowd.count = 2;
  const SmallCrowdFolder folder(crowd);
  folder.folder().write("heads/bowl.mtl", "newmtl skin\n");
  for (const auto& head : fs::directory_iterator(folder / "heads")) {
    if (head.path().extension() != ".obj") continue;
    std::string text = testing::read_text(head.path());
    const std::string line = "mtllib bowl.mtl";
    text.replace(text.find(line), line.size(), "mtllib C:\\work\\bowl.mtl");
    folder.folder().write(concat("heads/", head.path().filename().string()), text);
  }
  ConfigOverrides overrides;
  overrides.assignments = {"output.lods=[40 %]"};
  generate(folder.config(), overrides, GenerateOptions{folder.cache(), Replace::kRefuse, false});
  const auto files = crowd_files(folder.out());
  for (const char* name : {"meshes/mob_0001.obj", "meshes/mob_0002+LOD1.obj"}) {
    EXPECT_NE(files.at(name).find("mtllib bowl.mtl\n"), std::string::npos) << name;
    EXPECT_EQ(files.at(name).find("work"), std::string::npos) << name;
  }
  EXPECT_TRUE(files.contains("meshes/bowl.mtl"));
}

TEST(Generate, MatchesThePlainMethodOnUdimTiles) {
  SmallCrowd crowd;
  crowd.regions = 5;
  crowd.udim = true;
  crowd.bowl.tiles = 3;  // whole columns of vertices lie on the tiles' borders
  crowd.bowl.materials = true;
  expect_crowd_is_right(crowd);
}

TEST(Generate, MatchesThePlainMethodInAnyUnit) {
  for (const auto& [units, per_cm] : {std::pair{"mm", 10.0}, {"m", 0.01}, {"in", 1 / 2.54}}) {
    SCOPED_TRACE(units);
    SmallCrowd crowd;
    crowd.units = units;
    crowd.bowl.per_cm = per_cm;
    crowd.regions = 3;
    crowd.smoothing_limit = "max_size: 90 mm";
    expect_crowd_is_right(crowd);
  }
}

TEST(Generate, CubicLevelsMatchALeastSquaresFit) {
  SmallCrowd crowd;
  crowd.levels = "cubic";
  crowd.regions = 3;
  crowd.operator_kind = "lazy";
  expect_crowd_is_right(crowd);
}

TEST(Generate, MemoryChangesNothingButTheSpeedAndTooLittleIsRefused) {
  for (const char* levels : {"basis", "exact"}) {
    SmallCrowd crowd;
    crowd.levels = levels;
    crowd.regions = 2;
    crowd.count = 7;
    const SmallCrowdFolder folder(crowd);
    const auto run = [&](std::uint64_t memory) {
      generate(folder.config(), {}, {folder.cache(), Replace::kRefuse, false, memory});
    };
    testing::expect_error(ExitCode::kUsage, {"needs", "--memory"}, [&] { run(20'000); });
    EXPECT_FALSE(std::filesystem::exists(folder.out()));
    run(0);
    const auto first = testing::crowd_files(folder.out());
    std::uint64_t tight = 20'000;  // the least that will do: one face at a time
    for (;; tight += 10'000) {
      std::filesystem::remove_all(folder.out());
      try {
        run(tight);
        break;
      } catch (const UsageError&) {
      }
    }
    EXPECT_THAT(testing::differing_files(testing::crowd_files(folder.out()), first),
                ::testing::IsEmpty());
  }
}

TEST(Generate, BasisLevelsMatchThePlainMethodWithinTheirTolerance) {
  for (const char* kind : {"umbrella", "lazy"}) {
    SmallCrowd crowd;
    crowd.levels = "basis";
    crowd.regions = 3;
    crowd.operator_kind = kind;
    expect_crowd_is_right(crowd);
  }
}

TEST(Generate, ManyIterationsMatchThePlainMethod) {
  SmallCrowd crowd;
  crowd.smoothing_limit = "max_iterations: 9000";
  crowd.sampling = "{smoothness: {iterations: [2000, 9000]}, max_sources: 3}";
  crowd.count = 2;
  expect_crowd_is_right(crowd);
}

TEST(Generate, NormalsAreThoseOfTheNewSurface) {
  SmallCrowd crowd;
  crowd.bowl.normals = true;
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const fs::path path = folder.out() / "meshes/mob_0001.obj";
  const reference::Obj mesh = reference::read_obj(path);
  const reference::Points expected = reference::vertex_normals(mesh, mesh.vertices);
  std::istringstream text(testing::read_text(path));
  std::size_t i = 0;
  for (std::string word; text >> word;) {
    if (word != "vn") continue;
    reference::Point n;
    text >> n[0] >> n[1] >> n[2];
    if (i + 1 == expected.size()) {
      EXPECT_EQ(n, (reference::Point{0, 0.6, 0.8})) << "a normal that no face uses stays";
    } else {
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(n[c], expected[i][c], 2e-5) << i;
    }
    ++i;
  }
  EXPECT_EQ(i, expected.size());
}

TEST(Generate, SameInputsGiveTheSameBytesOnAnyThreads) {
  SmallCrowd crowd;
  crowd.regions = 3;
  crowd.count = 5;
  crowd.contact_sheet = "{columns: 3, rows: 1, cell: 32}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const auto first = crowd_files(folder.out());
  EXPECT_TRUE(first.contains("sheets/sheet_002.png"));
  EXPECT_TRUE(first.contains("renders/mob_0005.png"));
  EXPECT_TRUE(first.contains("crowd.csv"));
  for (const int threads : {1, 8}) {
    fs::remove_all(folder.out());
    fs::remove_all(folder.cache());
    const ThreadLimit limit(threads);
    run(folder);
    EXPECT_THAT(differing_files(first, crowd_files(folder.out())), ::testing::IsEmpty()) << threads;
  }
  fs::remove_all(folder.out());
  run(folder);  // with prepared heads from the cache
  EXPECT_THAT(differing_files(first, crowd_files(folder.out())), ::testing::IsEmpty());
  EXPECT_EQ(testing::read_json(folder.out() / "timings.json").at("heads_from_cache"), 4);
}

TEST(Generate, LeavesNoTemporaryFiles) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : crowd_files(folder.out())) names.push_back(name);
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("casting.json", "config.yaml", "crowd.csv",
                                                     "ledger.jsonl", "plan.jsonl", "report.json",
                                                     "meshes/mob_0001.obj", "meshes/mob_0002.obj",
                                                     "meshes/mob_0003.obj", "meshes/mob_0004.obj"));
}

TEST(Generate, LargerCountKeepsTheFirstFaces) {
  const SmallCrowdFolder folder([] {
    SmallCrowd crowd;
    crowd.regions = 3;
    return crowd;
  }());
  run(folder);
  run_to(folder, "more", {{}, "9", {}, {}});
  const auto few = plan_lines(folder.out()), many = plan_lines(folder / "more");
  ASSERT_EQ(many.size(), 9U);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i], many[i]);
    const std::string mesh = concat("meshes/", few[i].at("id").get<std::string>(), ".obj");
    EXPECT_EQ(testing::read_text(folder.out() / mesh), testing::read_text(folder / "more" / mesh));
  }
}

TEST(Generate, AnotherSeedGivesOtherFaces) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder);
  run_to(folder, "other", {{}, {}, "12", {}});
  const auto a = crowd_files(folder.out()), b = crowd_files(folder / "other");
  for (const auto& [name, bytes] : a) EXPECT_NE(bytes, b.at(name)) << name;
}

TEST(Generate, EffectiveConfigGivesTheSameCrowd) {
  SmallCrowd crowd;
  crowd.regions = 3;
  crowd.more =
      "recipes: [{id: mine, target: bob, regions: {all: {weights: {ann: 1}, smoothness: 0.3}}}]\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const auto first = crowd_files(folder.out());
  fs::remove_all(folder.out() / "meshes");
  fs::remove(folder.out() / "ledger.jsonl");
  ConfigOverrides none;
  generate(folder.out() / "config.yaml", none, {folder.cache(), Replace::kRefuse, false});
  EXPECT_THAT(differing_files(first, crowd_files(folder.out())), ::testing::IsEmpty());
}

TEST(Generate, PositionOnTheTargetGivesTheTargetsFile) {
  SmallCrowd crowd;
  crowd.regions = 3;
  crowd.bowl.materials = true;
  crowd.sampling =
      "{targets: [bob], position: {distribution: fixed, position: [0.5, 0.25]}, extrapolation: 1}";
  crowd.more = "plane: {layout: circle, anchors: {bob: [0.5, 0.25]}}\n";
  for (const char* boundary : {"fixed", "free"}) {
    crowd.boundary = boundary;
    const SmallCrowdFolder folder(crowd);
    run(folder);
    EXPECT_EQ(testing::read_text(folder.out() / "meshes/mob_0001.obj"),
              testing::read_text(folder.head("bob")));
  }
}

TEST(Generate, CountZeroGivesAnEmptyCrowd) {
  SmallCrowd crowd;
  crowd.count = 0;
  crowd.contact_sheet = "{columns: 2, rows: 1, cell: 32}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  EXPECT_EQ(testing::read_text(folder.out() / "plan.jsonl"), "");
  EXPECT_EQ(testing::read_json(folder.out() / "report.json").at("reached").at("faces"), 0);
}

TEST(Generate, DryRunWritesNothing) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const auto before = crowd_files(folder.folder().path());
  generate(folder.config(), {}, {folder.cache(), Replace::kRefuse, true});
  plan(folder.config(), {}, {folder.cache(), Replace::kRefuse, true});
  EXPECT_THAT(differing_files(crowd_files(folder.folder().path()), before), ::testing::IsEmpty());
  EXPECT_FALSE(fs::exists(folder.out()));
  EXPECT_FALSE(fs::exists(folder.cache()));
}

TEST(Generate, PlanWritesNoMeshesAndTheSamePlan) {
  const SmallCrowdFolder folder(SmallCrowd{});
  ConfigOverrides overrides;
  plan(folder.config(), overrides, {folder.cache(), Replace::kRefuse, false});
  auto planned = crowd_files(folder.out());
  EXPECT_EQ(planned.size(), 5U) << "config.yaml, plan.jsonl, crowd.csv, casting.json, planned.json";
  run(folder);
  EXPECT_EQ(planned.erase("planned.json"), 1U);  // only for shards
  EXPECT_FALSE(crowd_files(folder.out()).contains("planned.json"));
  for (const auto& [name, bytes] : planned) EXPECT_EQ(bytes, crowd_files(folder.out()).at(name));
}

TEST(Generate, AnotherConfigsCrowdIsRefusedOrReplaced) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder);
  const auto before = crowd_files(folder.out());
  folder.folder().write("out/notes.txt", "mine");
  folder.folder().write("out/meshes/mine.obj", "mine");
  const ConfigOverrides other = {{}, "2", "99", {}};
  testing::expect_error(ExitCode::kUsage, {folder.out().string(), "--force"},
                        [&] { run(folder, other); });
  const auto refused = crowd_files(folder.out());
  for (const auto& [name, bytes] : before) EXPECT_EQ(refused.at(name), bytes);
  run(folder, other, Replace::kForce);
  const auto after = crowd_files(folder.out());
  EXPECT_FALSE(after.contains("meshes/mob_0003.obj")) << "the old crowd's";
  EXPECT_EQ(after.at("notes.txt"), "mine");
  EXPECT_EQ(after.at("meshes/mine.obj"), "mine");
  EXPECT_EQ(plan_lines(folder.out()).size(), 2U);
}

TEST(Generate, OutputThatCannotBeMadeIsRefusedBeforeTheWork) {
  const SmallCrowdFolder folder(SmallCrowd{});
  folder.folder().write("taken", "a file in the place of the folder");
  testing::expect_error(ExitCode::kCannotCreate, {"taken"}, [&] { run_to(folder, "taken"); });
  testing::expect_error(ExitCode::kCannotCreate, {"taken"}, [&] { run_to(folder, "taken/crowd"); });
  EXPECT_FALSE(fs::exists(folder.cache())) << "nothing was prepared";
  EXPECT_EQ(testing::read_text(folder / "taken"), "a file in the place of the folder");
}

TEST(Generate, MaterialFilesComeAlong) {
  SmallCrowd crowd;
  crowd.bowl.materials = true;
  const SmallCrowdFolder folder(crowd);
  run_to(folder, "without");
  EXPECT_THAT(testing::read_json(folder / "without/report.json").at("warnings").dump(),
              ::testing::HasSubstr("bowl.mtl"));
  const std::string library = "newmtl skin\nmap_Kd textures/skin.png\nnewmtl eye\nKd 1 1 1\n";
  folder.folder().write("heads/bowl.mtl", library);
  folder.folder().write("heads/textures/skin.png", "not really an image");
  run(folder);
  EXPECT_EQ(testing::read_text(folder.out() / "meshes/bowl.mtl"), library);
  EXPECT_EQ(testing::read_text(folder.out() / "meshes/textures/skin.png"), "not really an image");
}

// The report could not be written, so that no run came to its end.
TEST(Generate, NamesOfMaterialFilesMayHoldAnyBytes) {
  SmallCrowd crowd;
  crowd.bowl.materials = true;
  const SmallCrowdFolder folder(crowd);
  std::string long_name = "x";
  for (int i = 0; i < 100; ++i) long_name += "ä";
  folder.folder().write(
      "heads/bowl.mtl",
      "newmtl skin\nmap_Kd h\xe4ut.png\nmap_Ks h\xf6ren.png\nmap_Ka " + long_name + ".png\n");
  folder.folder().write("heads/h\xe4ut.png", "x");
  run(folder);
  const auto warnings = testing::read_json(folder.out() / "report.json").at("warnings");
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [](const auto& text) {
                            return text.template get<std::string>().starts_with("texture ");
                          }),
            3)
      << warnings.dump();
  EXPECT_TRUE(verify_crowd(folder.out()).is_intact());
}

// Heads of several folders may name different files alike; one crowd has room for one.
TEST(Generate, MaterialFilesOfOneNameAreWarnedOf) {
  SmallCrowd crowd;
  crowd.bowl.materials = true;
  crowd.count = 12;
  const SmallCrowdFolder folder(crowd);
  folder.folder().write("heads/bowl.mtl", "newmtl skin\n");
  folder.folder().write("more/bowl.mtl", "newmtl other\n");
  folder.folder().write("more/fay.obj", testing::bowl_text(crowd.bowl, 6));
  const std::string faces =
      "faces={files: [heads/ann.obj, heads/bob.obj, more/fay.obj], units: cm}";
  run(folder, {faces});
  EXPECT_EQ(testing::read_text(folder.out() / "meshes/bowl.mtl"), "newmtl skin\n");
  const auto warnings = testing::read_json(folder.out() / "report.json").at("warnings");
  const auto of_files = std::find_if(warnings.begin(), warnings.end(), [](const auto& text) {
    return text.template get<std::string>().find("bowl.mtl") != std::string::npos;
  });
  ASSERT_NE(of_files, warnings.end()) << warnings.dump();
  EXPECT_THAT(of_files->dump(), ::testing::HasSubstr("fay"));
}

// With --force the run would first remove the old crowd's meshes, its own input.
TEST(Generate, HeadsAmongTheMeshesAreNotWrittenOver) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder);
  const auto before = crowd_files(folder.out());
  const ConfigOverrides again = {{"faces={directory: out/meshes, units: cm}"}, {}, {}, {}};
  for (const Replace replace : {Replace::kRefuse, Replace::kForce}) {
    testing::expect_error(ExitCode::kUsage, {"out/meshes/mob_0001.obj", "--out"},
                          [&] { run(folder, again, replace); });
    EXPECT_THAT(differing_files(crowd_files(folder.out()), before), ::testing::IsEmpty());
  }
  run_to(folder, "second", again);  // a crowd of the crowd, elsewhere
  EXPECT_EQ(plan_lines(folder / "second").size(), 4U);
}

TEST(Generate, NoMeshesOnRequest) {
  SmallCrowd crowd;
  const SmallCrowdFolder folder(crowd);
  run(folder, {"output.meshes=[]"});
  EXPECT_FALSE(fs::exists(folder.out() / "meshes"));
  EXPECT_EQ(plan_lines(folder.out()).size(), 4U);
}

TEST(Generate, SheetsAreRemadeFromTheMeshes) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 3, rows: 1, cell: 48, views: [front, profile]}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const auto before = crowd_files(folder.out());
  fs::remove_all(folder.out() / "sheets");
  fs::remove_all(folder.out() / "renders");
  remake_sheets(folder.out(), {});
  EXPECT_THAT(differing_files(before, crowd_files(folder.out())), ::testing::IsEmpty());
}

// A host that has a config in memory had to write it to a file first.
TEST(Generate, TakesAConfigAtHandAsItTakesAFile) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder, {"crowd.count=3", "sampling.max_sources=2"});
  const auto expected = testing::crowd_files(folder.out());
  std::filesystem::remove_all(folder.out());
  Problems problems;
  std::optional<Config> config = read_config(folder.config(), {}, problems);
  ASSERT_TRUE(config);
  config->crowd.count = 3;
  config->sampling->max_sources = 2;
  generate(*config, {.cache = folder.cache()});
  EXPECT_THAT(testing::differing_files(expected, testing::crowd_files(folder.out())),
              ::testing::IsEmpty());

  config->file.clear();
  config->output.directory = folder / "planned";
  plan(*config, {.cache = folder.cache()});
  EXPECT_EQ(testing::read_text(folder / "planned/plan.jsonl"), expected.at("plan.jsonl"));

  config->sampling->max_sources = -2;
  testing::expect_error(ExitCode::kUsage, {"sampling.max_sources"},
                        [&] { generate(*config, {.cache = folder.cache()}); });
}

}  // namespace
}  // namespace crowdface
