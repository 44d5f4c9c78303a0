// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/text.h"

#include "cli/program_test.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(Synth, TagsAreWhatAConfigTakes) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string();
  crowdface(0, {"synth", "-o", heads, "--count", "12", "--vertices", "5000", "--tags"});
  const std::string tags = read_text(folder / "heads/tags.yaml");
  for (const char* tag : {"[female", "[male", "young", "adult", "old"}) {
    EXPECT_THAT(tags, HasSubstr(tag)) << "among twelve people";
  }
  const fs::path config = folder.write(
      "crowd.yaml", concat("schema: 1\ncrowd: {name: mob, count: 1}\noutput: {directory: out}\n",
                           tags, "  directory: heads\n  units: cm\n",
                           "sampling: {targets: [female, old], sources: [male, young, adult]}\n"));
  crowdface(0, {"check", config.string()}, {"is fine"});
}

TEST(Synth, WritesNoTagsUnasked) {
  const TemporaryFolder folder;
  crowdface(0, {"synth", "-o", folder.path().string(), "--count", "1", "--vertices", "5000"});
  EXPECT_FALSE(fs::exists(folder / "tags.yaml"));
  EXPECT_TRUE(fs::exists(folder / "synth_01.obj"));
}

TEST(Synth, GoesOnAndKeepsWhatSomebodyChanged) {
  const TemporaryFolder folder;
  const std::vector<std::string> command = {
      "synth", "-o", (folder / "heads").string(), "--count", "3", "--vertices", "5000", "--tags"};
  crowdface(0, command);
  const std::string first = read_text(folder / "heads/synth_01.obj");
  const std::string last = read_text(folder / "heads/synth_03.obj");
  fs::remove(folder / "heads/synth_03.obj");
  crowdface(0, command);
  EXPECT_EQ(read_text(folder / "heads/synth_03.obj"), last);

  folder.write("heads/synth_01.obj", "sculpted\n");
  folder.write("heads/tags.yaml", "known better\n");
  fs::remove(folder / "heads/synth_03.obj");
  crowdface(64, command,
            {"heads/synth_01.obj: already exists", "heads/tags.yaml: already exists", "--force"});
  EXPECT_EQ(read_text(folder / "heads/synth_01.obj"), "sculpted\n");
  EXPECT_FALSE(fs::exists(folder / "heads/synth_03.obj")) << "nothing is written on refusal";

  std::vector<std::string> forced = command;
  forced.emplace_back("--force");
  crowdface(0, forced);
  EXPECT_EQ(read_text(folder / "heads/synth_01.obj"), first);
}

TEST(Synth, PaintsSkinsThatSheetsShow) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string();
  crowdface(0, {"synth", "-o", heads, "--count", "2", "--vertices", "5000", "--textures", "64"});
  EXPECT_TRUE(fs::exists(folder / "heads/synth_02_albedo.png"));
  EXPECT_THAT(read_text(folder / "heads/synth_02.obj"), HasSubstr("mtllib synth_02.mtl"));
  EXPECT_THAT(read_text(folder / "heads/synth_02.mtl"), HasSubstr("map_Kd synth_02_albedo.png"));
  const auto sheet = [&](const std::string& name, const char* texture) {
    const fs::path config = folder.write(
        concat(name, ".yaml"),
        concat("schema: 1\ncrowd: {name: mob, count: 1}\nfaces: {directory: heads, units: cm}\n",
               "output: {directory: ", name,
               ", contact_sheet: {columns: 1, rows: 1, cell: 64, texture: ", texture, "}}\n"));
    crowdface(0, {"generate", config.string(), "--cache", (folder / "cache").string()});
    return read_text(folder / concat(name, "/renders/mob_0001.png"));
  };
  EXPECT_NE(sheet("painted", "true"), sheet("plain", "false"));
  EXPECT_TRUE(fs::exists(folder / "painted/meshes/blended/mob_0001.png"));
  EXPECT_THAT(read_text(folder / "painted/meshes/mob_0001.mtl"),
              HasSubstr("map_Kd blended/mob_0001.png"));
  EXPECT_THAT(read_text(folder / "painted/meshes/mob_0001.obj"),
              HasSubstr("mtllib mob_0001.mtl\n"));

  for (const char* size : {"63", "9000", "big"}) {
    crowdface(64, {"synth", "-o", heads, "--textures", size}, {"--textures"});
  }
}

TEST(Synth, HairOfItsOwnIsWhatAConfigTakes) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string();
  crowdface(0, {"synth", "-o", heads, "--count", "3", "--vertices", "5000", "--textures", "64",
                "--hair"});
  EXPECT_THAT(read_text(folder / "heads/tags.yaml"), HasSubstr("_hair"));
  EXPECT_TRUE(fs::exists(folder / "heads/attachments/base.obj"));
  fs::rename(folder / "heads/tags.yaml", folder / "tags.yaml");
  crowdface(0, {"init", heads, "-o", (folder / "untagged.yaml").string()},
            {"attachments.yaml", "no head has the tags"});
  EXPECT_THAT(read_text(folder / "untagged.yaml"), Not(HasSubstr("from:")));
  fs::rename(folder / "tags.yaml", folder / "heads/tags.yaml");
  crowdface(0, {"init", heads, "-o", (folder / "crowd.yaml").string()});
  EXPECT_THAT(read_text(folder / "crowd.yaml"), HasSubstr("from: heads/attachments"));
  const fs::path out = folder / "out";
  crowdface(0, {"generate", (folder / "crowd.yaml").string(), "--count", "4", "--out", out.string(),
                "--cache", (folder / "cache").string(), "--set", "output.contact_sheet.cell=48"});
  const std::string plan = read_text(out / "plan.jsonl");
  EXPECT_THAT(plan, HasSubstr("\"attachments\":[\""));
}

TEST(Synth, ABodyIsWhatAConfigTakes) {
  const TemporaryFolder folder;
  crowdface(0, {"synth", "-o", (folder / "heads").string(), "--count", "4", "--vertices", "5000",
                "--textures", "64", "--body"});
  const fs::path config = folder.write(
      "crowd.yaml",
      "schema: 1\ncrowd: {name: mob, count: 2}\nfaces: {directory: heads, units: cm}\n"
      "neck: {body: heads/body/body.obj, body_texture: heads/body/body.png, show_body: true}\n"
      "output: {directory: out, contact_sheet: {cell: 64}}\n");
  crowdface(0, {"generate", config.string()});
  EXPECT_TRUE(fs::exists(folder / "out/meshes/blended/mob_0001.body.png"));
  crowdface(0, {"synth", "-o", (folder / "plain").string(), "--count", "1", "--vertices", "5000",
                "--body"});
  EXPECT_TRUE(fs::exists(folder / "plain/body/body.obj"));
  EXPECT_FALSE(fs::exists(folder / "plain/body/body.png"));
}

TEST(Synth, HairWithoutAPaintedScalpIsRefused) {
  const TemporaryFolder folder;
  crowdface(64, {"synth", "-o", (folder / "heads").string(), "--hair"}, {"--hair", "--textures"});
  EXPECT_FALSE(fs::exists(folder / "heads"));
}

}  // namespace
}  // namespace crowdface::testing
