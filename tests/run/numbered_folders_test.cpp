// SPDX-License-Identifier: Apache-2.0
// A crowd in numbered subfolders is the crowd that lies in one folder, and as whole.
#include <fstream>
#include <regex>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::crowd_files;
using testing::differing_files;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

constexpr const char* kThreePerFolder = "output.faces_per_folder=3";

SmallCrowd seven_faces() {
  SmallCrowd crowd;
  crowd.count = 7;
  crowd.bowl.materials = true;
  crowd.contact_sheet = "{columns: 2, rows: 1, cell: 32}";
  return crowd;
}

class NumberedFolders : public ::testing::Test {
 protected:
  NumberedFolders() : folder_(seven_faces()) {
    folder_.folder().write("heads/bowl.mtl", "newmtl skin\n");
  }
  void run(const std::vector<std::string>& set, const fs::path& out, Shard shard = {}) {
    GenerateOptions options{folder_.cache(), Replace::kRefuse, false};
    options.shard = shard;
    generate(folder_.config(), overrides(set, out), options);
  }
  static ConfigOverrides overrides(std::vector<std::string> set, const fs::path& out) {
    ConfigOverrides overrides;
    overrides.assignments = std::move(set);
    overrides.assignments.emplace_back("output.meshes=[obj, glb, points, usd]");
    overrides.assignments.emplace_back("output.lods=[40 %]");
    overrides.out = out.string();
    return overrides;
  }
  std::int64_t faces_built(const fs::path& out) const {
    return testing::read_json(out / "timings.json").at("faces").get<std::int64_t>();
  }

  SmallCrowdFolder folder_;
};

/// A name without its numbered folder.
std::string flat(const std::string& name) {
  static const std::regex number("(meshes|renders|sheets|data/faces)/[0-9]{3}/");
  return std::regex_replace(name, number, "$1/");
}

/// The text of a mesh, or of crowd.usda, that names what all share beside it.
std::string flat_text(const std::string& text) {
  static const std::regex usd("@\\.\\./"), obj("mtllib \\.\\./");
  return std::regex_replace(std::regex_replace(flat(text), usd, "@./"), obj, "mtllib ");
}

TEST_F(NumberedFolders, HoldTheSameFilesButForTheirPlaces) {
  run({}, folder_.out());
  run({kThreePerFolder}, folder_ / "numbered");
  const auto numbered = crowd_files(folder_ / "numbered");
  std::map<std::string, std::string> as_flat;
  for (const auto& [name, bytes] : numbered) {
    const bool is_text = name.ends_with(".obj") || name.ends_with(".usda");
    as_flat[flat(name)] = is_text ? flat_text(bytes) : bytes;
  }
  auto expected = crowd_files(folder_.out());
  for (const char* name :
       {"config.yaml", "ledger.jsonl", "report.json",  // name files, or hash them
        "gallery/data/crowd.js", "gallery/data/pages/000.js", "gallery/data/pages/001.js",
        "gallery/data/pages/002.js"}) {
    as_flat.erase(name);
    expected.erase(name);
  }
  EXPECT_THAT(differing_files(expected, as_flat), IsEmpty());
  for (const char* name :
       {"meshes/000/mob_0002.obj", "meshes/001/mob_0003.glb", "meshes/002/mob_0007+LOD1.obj",
        "renders/002/mob_0006.png", "sheets/000/sheet_001.png", "sheets/001/sheet_004.png"}) {
    EXPECT_TRUE(numbered.contains(name)) << name;
  }
  // What all share is found from there.
  EXPECT_NE(numbered.at("meshes/001/mob_0004.obj").find("mtllib ../bowl.mtl"), std::string::npos);
  EXPECT_NE(numbered.at("meshes/001/mob_0004+LOD1.obj").find("mtllib ../bowl.mtl"),
            std::string::npos);
  EXPECT_TRUE(numbered.contains("meshes/bowl.mtl"));
  EXPECT_NE(numbered.at("crowd.usda").find("@./meshes/002/mob_0007.usda@"), std::string::npos);
}

TEST_F(NumberedFolders, VerifyMissesAFileAndTheNextRunMakesItAgain) {
  const fs::path out = folder_.out();
  run({kThreePerFolder}, out);
  const auto whole = crowd_files(out);
  EXPECT_TRUE(verify_crowd(out).is_intact());
  for (const char* name : {"meshes/001/mob_0004.npy", "renders/002/mob_0007.png"}) {
    fs::remove(out / name);
    EXPECT_THAT(verify_crowd(out).missing_files, ElementsAre(name));
    run({kThreePerFolder}, out);
    EXPECT_EQ(faces_built(out), 1) << name;
    EXPECT_THAT(differing_files(whole, crowd_files(out)), IsEmpty()) << name;
  }
  fs::remove_all(out / "meshes/001");
  fs::remove(out / "sheets/001/sheet_004.png");
  run({kThreePerFolder}, out);
  EXPECT_EQ(faces_built(out), 3);
  EXPECT_THAT(differing_files(whole, crowd_files(out)), IsEmpty());
}

TEST_F(NumberedFolders, ARunThatWasKilledGoesOn) {
  const fs::path out = folder_.out();
  run({kThreePerFolder}, out);
  const auto whole = crowd_files(out);
  // As if it had died within the fifth face's line: no report, half a ledger.
  fs::remove(out / "report.json");
  const std::string& ledger = whole.at("ledger.jsonl");
  const std::size_t fifth = ledger.find("{\"item\":\"faces/mob_0005\"");
  ASSERT_NE(fifth, ledger.npos);
  std::ofstream(out / "ledger.jsonl", std::ios::binary) << ledger.substr(0, fifth + 40);
  fs::remove_all(out / "meshes/002");
  run({kThreePerFolder}, out);
  EXPECT_EQ(faces_built(out), 3);
  EXPECT_THAT(differing_files(whole, crowd_files(out)), IsEmpty());
}

TEST_F(NumberedFolders, ShardsAndGatherGiveWhatOneRunGives) {
  const fs::path out = folder_.out();
  run({kThreePerFolder}, out);
  const auto whole = crowd_files(out);
  fs::remove_all(out);
  for (const std::uint64_t shard : {2U, 1U}) run({kThreePerFolder}, out, {shard, 2});
  gather(out, folder_.cache());
  EXPECT_THAT(differing_files(whole, crowd_files(out)), IsEmpty());
  remake_sheets(out, {}, folder_.cache());
  EXPECT_THAT(differing_files(whole, crowd_files(out)), IsEmpty());
}

TEST_F(NumberedFolders, AnotherCrowdWithForceLeavesNothingOfThem) {
  const fs::path out = folder_.out();
  run({kThreePerFolder}, out);
  generate(folder_.config(), overrides({"crowd.seed=5"}, out),
           {folder_.cache(), Replace::kForce, false});
  for (const auto& [name, bytes] : crowd_files(out)) EXPECT_EQ(flat(name), name);
  EXPECT_FALSE(fs::exists(out / "meshes/000"));
  EXPECT_FALSE(fs::exists(out / "gallery/data/pages"));
}

TEST_F(NumberedFolders, FacesAreComparedWithThoseOfAnotherCrowd) {
  run({kThreePerFolder}, folder_ / "numbered");
  run({"output.contact_sheet.compare=numbered"}, folder_.out());  // each with itself
  fs::remove(folder_ / "numbered/meshes/002/mob_0007.obj");
  for (const char* ending : {"npy", "glb", "usda"}) {
    fs::remove(folder_ / concat("numbered/meshes/002/mob_0007.", ending));
  }
  testing::expect_error(ExitCode::kMissingInput, {"mob_0007", "to compare with"},
                        [&] { run({"output.contact_sheet.compare=numbered"}, folder_ / "again"); });
}

std::optional<std::uint64_t> faces_per_folder(const SmallCrowdFolder& folder, int count,
                                              int seed = 1) {
  ConfigOverrides overrides;
  overrides.count = std::to_string(count);
  overrides.seed = std::to_string(seed);
  return load_job(folder.config(), overrides).config.output.faces_per_folder;
}

TEST_F(NumberedFolders, AreForLargeCrowdsAlone) {
  EXPECT_EQ(faces_per_folder(folder_, 10'000), std::nullopt);
  EXPECT_EQ(faces_per_folder(folder_, 10'001), 1000U);
}

TEST_F(NumberedFolders, ALargeCrowdThatLiesInOneFolderStaysThere) {
  ConfigOverrides overrides;
  overrides.count = "10001";
  overrides.seed = "1";
  Job job = load_job(folder_.config(), overrides);
  job.config.output.faces_per_folder.reset();  // as versions wrote it that knew no subfolders
  folder_.folder().write("out/config.yaml",
                         stored_config_text(job.config, crowd_directory_of(job.config)));
  EXPECT_EQ(faces_per_folder(folder_, 10'001), std::nullopt);
  EXPECT_EQ(load_job(folder_.out() / "config.yaml", {}).config.output.faces_per_folder,
            std::nullopt);
  EXPECT_EQ(faces_per_folder(folder_, 10'001, 2), 1000U) << "another crowd, which replaces it";
}

}  // namespace
}  // namespace crowdface
