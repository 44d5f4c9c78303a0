// SPDX-License-Identifier: Apache-2.0
// Commands that read a config: check, init, plan, generate, blend, sheet, cache.
#include <chrono>
#include <cstdio>
#include <sstream>
#include <thread>

#include <signal.h>

#include "crowdface/core/text.h"
#include "crowdface/io/obj_template.h"
#include "crowdface/run/generate.h"

#include "cli/program_test.h"
#include "support/crowd_files.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

SmallCrowd three_regions() {
  SmallCrowd crowd;
  crowd.regions = 3;
  return crowd;
}

TEST(Blend, RebuildsAFaceByteForByte) {
  const SmallCrowdFolder folder(three_regions());
  const std::string config = folder.config().string(), cache = folder.cache().string();
  const std::string plan = (folder.out() / "plan.jsonl").string();
  const std::string log = (folder / "own.log").string();
  crowdface(0, {"generate", config, "--cache", cache, "--threads", "2", "--log-file", log},
            {"4 faces"});
  EXPECT_THAT(read_text(log), ::testing::HasSubstr("4 faces in")) << "beside the crowd's log";
  const fs::path again = folder / "again.obj";
  const auto blend = [&](int code, const std::string& id, std::vector<std::string> more,
                         const std::vector<std::string>& phrases) {
    std::vector<std::string> arguments = {"blend",    config,          "--cache", cache,
                                          "--recipe", plan + "#" + id, "-o",      again.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    fs::remove(again);
    crowdface(code, arguments, phrases);
    EXPECT_EQ(fs::exists(again), code == 0);
  };
  blend(0, "mob_0003", {}, {});
  EXPECT_EQ(read_text(again), read_text(folder.out() / "meshes/mob_0003.obj"));
  blend(65, "mob_0033", {}, {"mob_0033", "did you mean mob_0003"});
  blend(65, "mob_0003", {"--set", "smoothing.operator=lazy"}, {"other settings", "--any-settings"});
  blend(0, "mob_0003", {"--set", "smoothing.operator=lazy", "--any-settings"}, {});
  EXPECT_NE(read_text(again), read_text(folder.out() / "meshes/mob_0003.obj"));
}

TEST(Blend, WritesTheFormatThatTheNameEndsIn) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const std::string config = folder.config().string(), cache = folder.cache().string();
  const std::string recipe = (folder.out() / "plan.jsonl").string() + "#mob_0002";
  crowdface(
      0, {"generate", config, "--cache", cache, "--set", "output.meshes=[ply, glb, points, obj]"});
  const auto blend = [&](int code, const std::string& out, const std::vector<std::string>& said) {
    crowdface(
        code,
        {"blend", config, "--cache", cache, "--recipe", recipe, "-o", (folder / out).string()},
        said);
  };
  for (const std::string ending : {"ply", "glb", "npy"}) {
    blend(0, "face." + ending, {});
    EXPECT_TRUE(read_text(folder / ("face." + ending)) ==
                read_text(folder.out() / ("meshes/mob_0002." + ending)))
        << ending;
  }
  blend(64, "face.step", {"--output", ".obj, .ply, .glb, .npy or .usda", "face.step"});
  EXPECT_FALSE(fs::exists(folder / "face.step"));
  blend(73, "nowhere/face.glb", {"nowhere/face.glb"});
}

// A layer names the eyes' iris beside itself.
TEST(Blend, BringsAlongWhatALayerNames) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string(), out = (folder / "out").string();
  const std::string cache = (folder / "cache").string();
  const std::string config = (folder / "crowd.yaml").string();
  crowdface(0, {"synth", "-o", heads, "--count", "2", "--vertices", "5000"});
  folder.write("crowd.yaml",
               "schema: 1\ncrowd: {name: mob, count: 1}\nfaces: {directory: heads, units: cm}\n"
               "output: {directory: out, meshes: [usd], contact_sheet: none}\n");
  crowdface(0, {"generate", config, "--cache", cache});
  crowdface(0, {"blend", config, "--cache", cache, "--recipe", out + "/plan.jsonl#mob_0001", "-o",
                (folder / "face.usda").string()});
  EXPECT_EQ(read_text(folder / "face.usda"), read_text(folder / "out/meshes/mob_0001.usda"));
  EXPECT_THAT(read_text(folder / "face.usda"), ::testing::HasSubstr("@./topology/iris.png@"));
  EXPECT_EQ(read_text(folder / "topology/iris.png"),
            read_text(folder / "out/meshes/topology/iris.png"));
}

TEST(Check, GoodConfigsPassAndNothingIsWritten) {
  const SmallCrowdFolder folder(three_regions());
  const auto before = crowd_files(folder.folder().path());
  crowdface(0, {"check", folder.config().string()},
            {"is fine", "4: ann, bob, cyd, dan", "119 vertices", "3 components", "60 iterations"});
  EXPECT_THAT(differing_files(crowd_files(folder.folder().path()), before), ::testing::IsEmpty());
  EXPECT_FALSE(fs::exists(folder.out()));
}

TEST(Check, TellsBandsAndFamilies) {
  SmallCrowd crowd;
  crowd.count = 5;
  crowd.sampling = "{bands: {build: 0.9, skin: 0.3}}";
  crowd.more = "families: [{name: kin, members: 3, parents: {mother: drawn, father: ann}}]\n";
  const SmallCrowdFolder folder(crowd);
  crowdface(0, {"check", folder.config().string()},
            {"bands       build, skin", "5 sampled, 0 by hand, 4 in families", "symmetry"});
}

TEST(Check, MasksAreRendered) {
  SmallCrowd crowd;
  crowd.regions = 2;
  const SmallCrowdFolder folder(crowd);
  crowdface(0, {"check", folder.config().string(), "--masks", (folder / "masks").string()});
  const auto pictures = crowd_files(folder / "masks");
  EXPECT_EQ(pictures.size(), 3U);
  for (const char* name : {"region_1.png", "region_2.png", "all.png"}) {
    ASSERT_TRUE(pictures.contains(name));
    EXPECT_EQ(pictures.at(name).substr(1, 3), "PNG");
  }
}

TEST(Check, EveryProblemIsToldAndTheFirstKindSetsTheCode) {
  const SmallCrowdFolder folder(three_regions());
  const std::string config = folder.config().string();
  // 64, 66 and 65 in one: a wrong key, a missing mask, a head that cannot be read.
  std::string text = read_text(folder.config());
  folder.folder().write("heads/bob.obj", "v 1 2 x\n");
  fs::remove(folder / "mask_0.png");
  folder.folder().write("config.yaml", text + "extra: 1\n" + "plane: {layout: circel}\n");
  crowdface(
      64, {"check", config},
      {"config.yaml:10:1", "extra", "config.yaml:11:17", "circle", "mask_0.png", "bob.obj:1"});
  // 66 and 65.
  folder.folder().write("config.yaml", text);
  crowdface(66, {"check", config}, {"config.yaml:4:", "mask_0.png", "bob.obj:1"});
  // 65 alone: every bad head.
  folder.folder().write("heads/dan.obj", "v 1 2\n");
  crowdface(65, {"check", config, "--set", "regions=none"}, {"bob.obj:1", "dan.obj:1"});
  crowdface(66, {"check", (folder / "none.yaml").string()}, {"none.yaml"});
}

TEST(Init, WritesAConfigThatPasses) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const std::string heads = (folder / "heads").string(),
                    config = (folder / "my/crowd.yaml").string();
  fs::create_directories(folder / "my");
  fs::rename(folder.head("dan"), folder / "heads/dan.OBJ");
  folder.folder().write("heads/._ann.obj", "what some systems put beside a file");
  crowdface(0, {"init", heads, "-o", config}, {"4 heads"});
  const std::string text = read_text(config);
  EXPECT_THAT(text, ::testing::HasSubstr("units: cm"));
  crowdface(0, {"check", config}, {"is fine"});
  crowdface(64, {"init", heads, "-o", config}, {"--force"});
  EXPECT_EQ(read_text(config), text);
}

TEST(Init, AlignsHeadsThatStandDifferently) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string(), config = (folder / "my.yaml").string();
  crowdface(0, {"synth", "-o", heads, "--count", "4", "--vertices", "5000"});
  crowdface(0, {"init", heads, "-o", config});
  EXPECT_THAT(read_text(config), ::testing::HasSubstr("align: check"));
  // Moves one head by 10 cm to the side.
  std::istringstream before(read_text(folder / "heads/synth_02.obj"));
  std::string moved;
  for (std::string line; std::getline(before, line);) {
    double x = 0, y = 0, z = 0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
      line = concat("v ", x + 10, ' ', y, ' ', z);
    moved += line + '\n';
  }
  folder.write("heads/synth_02.obj", moved);
  crowdface(0, {"init", heads, "-o", config, "--force"}, {"turned or moved", "align: rigid"});
  const Outcome checked = crowdface(0, {"check", config}, {"is fine"});
  EXPECT_THAT(checked.err, ::testing::Not(::testing::HasSubstr("is not aligned")));
}

// The mean of three heads of which one was mirrored, or ten times as large, had another unit and axes.
TEST(Init, TellsHeadsThatCheckRefusesAndLeavesThemOut) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string(), config = (folder / "c.yaml").string();
  crowdface(0, {"synth", "-o", heads, "--count", "3", "--vertices", "5000"});
  fs::rename(folder / "heads/synth_02.obj", folder / "plain.obj");
  const ObjFile plain = read_obj(folder / "plain.obj");
  const auto write_scaled = [&](double x, double all) {
    Positions positions = all * plain.positions;
    positions.col(0) *= x;
    folder.write("heads/synth_02.obj",
                 ObjTemplate(plain, plain.topology).encode(positions, "odd").text());
  };
  write_scaled(-1, 1);
  crowdface(0, {"init", heads, "-o", config},
            {"head synth_02 is mirrored", "assumed unit: cm", "along +Z with +Y up"});
  write_scaled(1, 10);
  crowdface(0, {"init", heads, "-o", config, "--force"},
            {"head synth_02: expected heads in one unit", "assumed unit: cm"});
}

// `init` wrote a config that `check` refused.
TEST(Init, RefusesNamesAndLinksThatCheckRefuses) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string(), config = (folder / "c.yaml").string();
  crowdface(0, {"synth", "-o", heads, "--count", "2", "--vertices", "5000"});
  const fs::path odd = folder / "heads/all.obj";
  fs::copy(folder / "heads/synth_01.obj", odd);
  crowdface(65, {"init", heads, "-o", config}, {"cannot have the name \"all\"", "rename"});
  fs::rename(odd, folder / "heads/synth_01.OBJ");
  crowdface(65, {"init", heads, "-o", config}, {"two heads are called \"synth_01\""});
  fs::remove(folder / "heads/synth_01.OBJ");
  fs::create_symlink("gone.obj", folder / "heads/ann.obj");
  crowdface(66, {"init", heads, "-o", config}, {"ann.obj: is a link to a file that is missing"});
}

TEST(Init, TakesTheMaskAndTheTagsBesideTheHeads) {
  const TemporaryFolder folder;
  const std::string config = (folder / "crowd.yaml").string();
  crowdface(0, {"synth", "-o", (folder / "heads").string(), "--count", "3", "--vertices", "5000",
                "--tags"});
  crowdface(0, {"init", (folder / "heads").string(), "-o", config}, {"regions.png"});
  crowdface(0, {"check", config}, {"is fine", "top, middle, bottom"});
  crowdface(0, {"check", config, "--set", "sampling.targets=[male, female]"}, {"is fine"});
  crowdface(65, {"check", config, "--set", "faces.units=in"}, {"set units: cm", "align: none"});
  crowdface(65, {"check", config, "--set", "faces.up=+Z", "--set", "faces.front=-Y"},
            {"set up: +Y and front: +Z"});
  crowdface(0, {"check", config, "--set", "faces.units=m", "--set", "faces.align=none"},
            {"is fine"});
  for (const char* input : {"heads/tags.yaml", "heads/regions.png"}) {
    crowdface(64, {"init", (folder / "heads").string(), "-o", (folder / input).string(), "--force"},
              {"is an input"});
  }
}

TEST(Init, ProposesRegionsWhereHeadsBringNone) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string(), config = (folder / "my.yaml").string();
  crowdface(0, {"synth", "-o", heads, "--count", "2", "--vertices", "5000"});
  fs::remove(folder / "heads/regions.png");
  crowdface(0, {"init", heads, "-o", config}, {"my_bands.png", "from the heads' shape"});
  crowdface(0, {"check", config}, {"is fine", "brow, nose, mouth"});
  fs::remove(config);
  crowdface(64, {"init", heads, "-o", config}, {"my_bands.png", "--force"});
  EXPECT_FALSE(fs::exists(config));
}

TEST(Mask, GoesFromAFolderOrAConfigIntoOne) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string(), mask = (folder / "bands.png").string();
  crowdface(0, {"synth", "-o", heads, "--count", "2", "--vertices", "5000"});
  const Outcome first = crowdface(
      0, {"mask", heads, "-o", mask, "--bands", "brow,nose,mouth,ears,neck", "--size", "512"});
  EXPECT_THAT(first.out, ::testing::HasSubstr("names: [brow, nose, mouth, ears, neck]"));
  folder.write("crowd.yaml", "schema: 1\ncrowd: {name: x, count: 2, seed: 1}\nfaces: {directory: " +
                                 heads + ", units: cm}\noutput: {directory: out}\n" + first.out);
  const std::string config = (folder / "crowd.yaml").string();
  crowdface(0, {"check", config}, {"is fine", "brow, nose, mouth, ears, neck"});
  crowdface(64, {"mask", config, "-o", mask}, {"already exists with other contents"});
  crowdface(0, {"mask", config, "-o", mask, "--force"}, {"[brow, nose, mouth]"});
  crowdface(64, {"mask", heads, "-o", mask, "--up", "+Z", "--front", "-Z"}, {"--up"});
  crowdface(65, {"mask", heads, "-o", mask, "--up", "+Z", "--front", "+X"}, {"along +Z with +Y"});
  crowdface(64, {"mask", heads, "-o", (folder / "mask.jpg").string()}, {"PNG"});
  crowdface(66, {"mask", (folder / "none").string(), "-o", mask}, {"none"});
}

TEST(Plan, BuildsNoMeshesAndKeepsTheCache) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const std::string cache = folder.cache().string();
  crowdface(0, {"plan", folder.config().string(), "--cache", cache}, {"4 recipes"});
  EXPECT_EQ(plan_lines(folder.out()).size(), 4U);
  EXPECT_FALSE(fs::exists(folder.out() / "meshes"));
  crowdface(0, {"cache", "--cache", cache}, {cache, "4 prepared heads"});
  crowdface(0, {"cache", "--cache", cache, "--clear"}, {"5 entries removed"});
  EXPECT_TRUE(fs::is_empty(folder.cache()));
  const std::string log = (folder / "dry.log").string();
  crowdface(0,
            {"generate", folder.config().string(), "--cache", cache, "--dry-run", "--log-file", log,
             "--out", (folder / "dry").string()},
            {"dry run", "4 faces", "119 vertices"});
  EXPECT_THAT(read_text(log), ::testing::HasSubstr("dry run"));
  EXPECT_FALSE(fs::exists(folder / "dry"));
}

TEST(Plan, TellsAtOnceThatFarTooManyFacesAreAskedFor) {
  SmallCrowd crowd;
  crowd.count = 1'000'000;
  crowd.more = "diversity: {min_distance: 0.06 mm}\n";
  const SmallCrowdFolder folder(crowd);
  const Outcome outcome =
      crowdface(3, {"plan", folder.config().string()},
                {"mm (estimate, to a factor of three), but 1000000", "of 1000000 faces"});
  EXPECT_LT(outcome.err.find("mm (estimate, to a factor of three), but 1000000"),
            outcome.err.find("of 1000000 faces"));
}

TEST(Sheet, IsRemadeIdentical) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 2, rows: 1, cell: 40}";
  const SmallCrowdFolder folder(crowd);
  generate(folder.config(), {}, {folder.cache(), Replace::kRefuse, false});
  const auto before = crowd_files(folder.out());
  fs::remove_all(folder.out() / "sheets");
  crowdface(0, {"sheet", folder.out().string()}, {"2 sheets"});
  EXPECT_THAT(differing_files(before, crowd_files(folder.out())), ::testing::IsEmpty());
  crowdface(66, {"sheet", (folder / "heads").string()}, {"config.yaml"});
}

TEST(Verify, TellsWhatIsWrongAndGenerateMendsIt) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const std::string out = folder.out().string(), config = folder.config().string(),
                    cache = folder.cache().string();
  crowdface(0, {"generate", config, "--cache", cache, "--shard", "2/2"}, {"shard 2of2", "2 faces"});
  crowdface(66, {"gather", out, "--cache", cache}, {"mob_0001", "2 of 4"});
  crowdface(65, {"verify", out}, {"not finished: mob_0003", "gathered"});
  crowdface(0, {"generate", config, "--cache", cache, "--shard=1/2"});
  crowdface(0, {"gather", out, "--cache", cache}, {"4 faces"});
  crowdface(0, {"verify", out}, {"all 9 files"});
  fs::remove(folder.out() / "meshes/mob_0001.obj");
  folder.folder().write("out/crowd.csv", "altered");
  crowdface(65, {"verify", out}, {"missing: meshes/mob_0001.obj", "altered: crowd.csv"});
  crowdface(0, {"generate", config, "--cache", cache}, {"3 of them done before"});
  crowdface(0, {"verify", out});
}

TEST(Limits, AreSetByTheCommandLine) {
  const SmallCrowdFolder folder(three_regions());
  const std::string config = folder.config().string();
  crowdface(0, {"check", config, "--limit", "vertices=119", "--limit", "yaml_depth=3"});
  crowdface(65, {"check", config, "--limit", "vertices=118"}, {"at most 118 vertices", "119"});
  crowdface(65, {"check", config, "--limit", "faces=20"}, {"at most 20 faces"});
  crowdface(65, {"check", config, "--limit", "image_pixels=100"}, {"at most 100 pixels", "mask_0"});
  crowdface(64, {"check", config, "--limit", "yaml_depth=1"}, {"config.yaml:2:", "1 levels"});
  crowdface(64, {"check", config, "--limit", "yaml_bytes=50"}, {"config.yaml:1:1", "50 bytes"});
}

TEST(Generate, InterruptedRunIs75AndItsRerunIsComplete) {
  SmallCrowd crowd = three_regions();
  crowd.count = 16;
  crowd.contact_sheet = "{columns: 8, rows: 2, cell: 128}";
  const SmallCrowdFolder folder(crowd);
  generate(folder.config(), {}, {folder.cache(), Replace::kRefuse, false});
  const auto whole = crowd_files(folder.out());
  fs::remove_all(folder.out());

  const std::vector<std::string> command = {
      "generate", folder.config().string(), "--cache", folder.cache().string(), "--threads", "2"};
  const Outcome stopped = run_program(CROWDFACE_PROGRAM, command, [&](pid_t child) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!fs::exists(folder.out() / "meshes/mob_0001.obj") &&
           std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ::kill(child, SIGTERM);
  });
  EXPECT_EQ(stopped.code, 75) << stopped.err;
  EXPECT_THAT(stopped.err, ::testing::HasSubstr("run the same command again"));
  auto part = crowd_files(folder.out());
  EXPECT_FALSE(part.contains("report.json"));
  EXPECT_EQ(part.erase("planned.json"),
            1U);  // the rerun takes the plan; a finished crowd needs it no more
  for (const auto& [name, bytes] : part) {
    ASSERT_TRUE(whole.contains(name)) << name << ": a temporary file was left";
    EXPECT_TRUE(name == "ledger.jsonl" || bytes == whole.at(name))
        << name << ": half done under its final name";
  }
  crowdface(0, command);
  EXPECT_THAT(differing_files(whole, crowd_files(folder.out())), ::testing::IsEmpty());
}

}  // namespace
}  // namespace crowdface::testing
