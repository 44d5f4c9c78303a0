// SPDX-License-Identifier: Apache-2.0
// A crowd's folder is made whole again from whatever is left of it, with the same bytes.
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/generate.h"

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

/// All that a crowd may have: several formats, pictures, materials, judged skins.
SmallCrowd everything() {
  SmallCrowd crowd;
  crowd.regions = 3;
  crowd.count = 7;
  crowd.levels = "basis";
  crowd.bowl.materials = true;
  crowd.contact_sheet = "{columns: 2, rows: 2, cell: 32}";
  crowd.more = "\nshapes: {neutral: heads/ann.obj, directory: shapes}";
  return crowd;
}

/// The folder of such a crowd, and how its finished files look.
class Resume : public ::testing::Test {
 protected:
  Resume() : folder_(everything()) {
    folder_.folder().write("heads/bowl.mtl", "newmtl skin\n");
    folder_.folder().write("shapes/smile.obj", testing::bowl_text(folder_.crowd().bowl, 40));
    run();
    whole_ = crowd_files(folder_.out());
  }
  void run(Shard shard = {}, Replace replace = Replace::kRefuse) {
    GenerateOptions options{folder_.cache(), replace, false};
    options.shard = shard;
    options.memory_bytes = memory_;
    generate(folder_.config(), overrides(), options);
  }
  static ConfigOverrides overrides() {
    ConfigOverrides all_formats;
    all_formats.assignments = {"output.meshes=[obj, glb, points]", "output.lods=[40 %]"};
    return all_formats;
  }
  /// Alters a head's file and casts the crowd anew: what is there was made from another.
  void edit_a_head() {
    const std::string head = testing::read_text(folder_.head("bob"));
    folder_.folder().write("heads/bob.obj", "# edited\n" + head);
    plan(folder_.config(), overrides(), {folder_.cache(), Replace::kForce, false});
  }
  std::int64_t faces_built() const {
    return testing::read_json(folder_.out() / "timings.json").at("faces").get<std::int64_t>();
  }
  void expect_whole(const std::string& what) const {
    EXPECT_THAT(differing_files(whole_, crowd_files(folder_.out())), IsEmpty()) << what;
  }

  std::uint64_t memory_ = 0;  ///< what runs may take; 0: what there is
  SmallCrowdFolder folder_;
  std::map<std::string, std::string> whole_;
};

TEST_F(Resume, AFinishedCrowdIsNotTouched) {
  EXPECT_EQ(faces_built(), 7);
  for (const auto& [name, bytes] : whole_) {
    if (name != "config.yaml") fs::last_write_time(folder_.out() / name, fs::file_time_type());
  }
  run();
  EXPECT_EQ(faces_built(), 0);
  expect_whole("again");
  for (const auto& [name, bytes] : whole_) {
    if (name == "config.yaml") continue;
    EXPECT_EQ(fs::last_write_time(folder_.out() / name), fs::file_time_type()) << name;
  }
}

TEST_F(Resume, EveryFileThatIsLostOrAlteredIsMadeAgain) {
  for (const auto& [name, bytes] : whole_) {
    if (name == "config.yaml") continue;  // without it, it is no crowd's folder
    const bool of_a_face = name.find("mob_") != name.npos;
    fs::remove(folder_.out() / name);
    run();
    expect_whole(name + " lost");
    EXPECT_EQ(faces_built(), name == "ledger.jsonl" ? 7 : of_a_face ? 1 : 0) << name;
    if (bytes.empty()) continue;
    std::string altered = bytes;
    altered[altered.size() / 2] = static_cast<char>(altered[altered.size() / 2] ^ 1);
    folder_.folder().write("out/" + name, altered);
    run();
    expect_whole(name + " altered");
    EXPECT_LE(faces_built(), 1) << name;
    folder_.folder().write("out/" + name, bytes.substr(0, bytes.size() / 2));
    run();
    expect_whole(name + " cut");
  }
}

TEST_F(Resume, ACrowdThatLostItsConfigIsKnownByItsLedger) {
  fs::remove(folder_.out() / "config.yaml");
  run();
  EXPECT_EQ(faces_built(), 0);
  expect_whole("config lost");
}

// They were replaced, and only the ledger was said to be damaged.
TEST_F(Resume, FilesOfSomebodyElseAreNotReplaced) {
  for (const char* name : {"plan.jsonl", "report.json", "crowd.csv", "ledger.jsonl",
                           "meshes/mob_0001.obj", "gallery/index.html"}) {
    fs::remove_all(folder_.out());
    folder_.folder().write(concat("out/", name), "mine\n");
    testing::expect_error(ExitCode::kUsage, {folder_.out().string(), "--force"}, [&] { run(); });
    EXPECT_EQ(testing::read_text(folder_.out() / name), "mine\n");
    EXPECT_FALSE(fs::exists(folder_.out() / "config.yaml")) << name;
  }
  run({}, Replace::kForce);
  expect_whole("forced");
}

TEST_F(Resume, VerifyMissesLinesOfTheLedger) {
  const std::string ledger = whole_.at("ledger.jsonl");
  std::size_t lines = 0;
  for (std::size_t begin = 0; begin < ledger.size(); ++lines) {
    const std::size_t end = ledger.find('\n', begin) + 1;
    folder_.folder().write("out/ledger.jsonl", ledger.substr(0, begin) + ledger.substr(end));
    EXPECT_FALSE(verify_crowd(folder_.out()).is_intact()) << "without line " << lines + 1;
    begin = end;
  }
  EXPECT_GT(lines, 12U);
  run();
  expect_whole("a line less");
}

TEST_F(Resume, VerifyNamesWhatIsMissingAndAltered) {
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
  EXPECT_EQ(verify_crowd(folder_.out()).file_count, whole_.size() - 1)
      << "all but the ledger itself";
  fs::remove(folder_.out() / "meshes/mob_0002.glb");
  folder_.folder().write("out/renders/mob_0003.png", "no picture");
  folder_.folder().write("out/sheets/sheet_001.png", "no sheet");
  const auto before = crowd_files(folder_.out());
  const CrowdCheck check = verify_crowd(folder_.out());
  EXPECT_THAT(check.missing_files, ElementsAre("meshes/mob_0002.glb"));
  EXPECT_THAT(check.altered_files, ElementsAre("renders/mob_0003.png", "sheets/sheet_001.png"));
  EXPECT_THAT(check.unfinished_items, IsEmpty());
  EXPECT_THAT(differing_files(before, crowd_files(folder_.out())), IsEmpty());
  run();
  expect_whole("repaired");
  folder_.folder().write("out/ledger.jsonl", "");
  const CrowdCheck without = verify_crowd(folder_.out());
  EXPECT_EQ(without.unfinished_items.size(), 9U) << "seven faces, plan and report";
  testing::expect_error(ExitCode::kMissingInput, {"config.yaml"},
                        [&] { verify_crowd(folder_ / "heads"); });
}

TEST_F(Resume, ShardsAndGatherGiveWhatOneRunGives) {
  for (const std::uint64_t shards : {2U, 7U, 9U}) {
    fs::remove_all(folder_.out());
    for (std::uint64_t shard = shards; shard >= 1; --shard) {
      testing::expect_error(ExitCode::kMissingInput, {shard == shards ? "config.yaml" : "mob_0001"},
                            [&] { gather(folder_.out(), folder_.cache()); });
      run({shard, shards});
      EXPECT_FALSE(fs::exists(folder_.out() / "report.json"));
    }
    EXPECT_EQ(verify_crowd(folder_.out()).unfinished_items,
              std::vector<std::string>{"report.json"});
    gather(folder_.out(), folder_.cache());
    expect_whole(concat(shards, " shards"));
    EXPECT_FALSE(fs::exists(folder_.out() / concat("crowdface-1of", shards, ".log")));
    EXPECT_THAT(testing::read_text(folder_.out() / "crowdface.log"),
                ::testing::HasSubstr(concat("shard 1of", shards)));
  }
  testing::expect_error(ExitCode::kUsage, {"--force"}, [&] { run({1, 2}, Replace::kForce); });
}

TEST_F(Resume, ShardsGoOnWithWhatAWholeRunHasDone) {
  fs::remove(folder_.out() / "meshes/mob_0002.obj");
  for (const auto& [name, bytes] : whole_) {
    if (name != "meshes/mob_0002.obj") {
      fs::last_write_time(folder_.out() / name, fs::file_time_type());
    }
  }
  run({1, 2});
  run({2, 2});
  for (const auto& [name, bytes] : whole_) {
    if (!name.starts_with("meshes/mob_") || name.find("mob_0002") != name.npos) continue;
    EXPECT_EQ(fs::last_write_time(folder_.out() / name), fs::file_time_type()) << name;
  }
  gather(folder_.out(), folder_.cache());
  expect_whole("a whole run, then shards");
}

// A finished crowd was made anew without a word, and could not be made again.
TEST_F(Resume, HeadsThatHaveChangedSinceAreRefused) {
  const std::string head = testing::read_text(folder_.head("bob"));
  folder_.folder().write("heads/bob.obj", "# edited\n" + head);
  testing::expect_error(ExitCode::kUsage, {folder_.out().string(), "other heads", "--force"},
                        [&] { run(); });
  expect_whole("refused");
  folder_.folder().write("heads/bob.obj", head);
  run();
  EXPECT_EQ(faces_built(), 0);
  // Nor does a plan alone, cast anew, open the way for heads that change once more.
  edit_a_head();
  folder_.folder().write("heads/bob.obj", "# and again\n" + head);
  testing::expect_error(ExitCode::kUsage, {"other heads"}, [&] { run(); });
}

// Sheets and gallery showed other heads, and verify found nothing.
TEST_F(Resume, SheetsOfHeadsThatHaveChangedSinceAreRefused) {
  const std::string ann = testing::read_text(folder_.head("ann"));
  folder_.folder().write("heads/ann.obj", testing::read_text(folder_.head("bob")));
  folder_.folder().write("heads/bob.obj", ann);
  testing::expect_error(ExitCode::kUsage, {folder_.out().string(), "other heads"},
                        [&] { remake_sheets(folder_.out(), {}, folder_.cache()); });
  expect_whole("refused");
}

TEST_F(Resume, ShardsOfHeadsThatHaveChangedSinceAreGathered) {
  edit_a_head();
  run({1, 2});
  run({2, 2});
  EXPECT_THAT(verify_crowd(folder_.out()).altered_files, IsEmpty());
  gather(folder_.out(), folder_.cache());
  const auto gathered = crowd_files(folder_.out());
  EXPECT_FALSE(differing_files(whole_, gathered).empty());
  fs::remove_all(folder_.out());
  run();
  EXPECT_THAT(differing_files(gathered, crowd_files(folder_.out())), IsEmpty());
}

// Old lines of another ledger were taken for the meshes of today.
TEST_F(Resume, SheetsMadeAnewBetweenShardsAndGatherAlterNoMesh) {
  edit_a_head();
  run({1, 2});
  run({2, 2});
  remake_sheets(folder_.out(), {"output.contact_sheet.cell=48"}, folder_.cache());
  EXPECT_THAT(verify_crowd(folder_.out()).altered_files, IsEmpty());
}

TEST_F(Resume, ARunThatOnlyGathersNeedsNoMemoryForFaces) {
  fs::remove_all(folder_.out());
  run({1, 2});
  run({2, 2});
  memory_ = 20'000;
  run();
  expect_whole("gathered in little memory");
}

TEST_F(Resume, GatherNamesAnAlteredFaceAndAnyRunMendsIt) {
  fs::remove_all(folder_.out());
  run({1, 2});
  run({2, 2});
  folder_.folder().write("out/meshes/mob_0004.npy", "altered");
  testing::expect_error(ExitCode::kMissingInput, {"1 of 7", "mob_0004", "number 4"},
                        [&] { gather(folder_.out(), folder_.cache()); });
  run();
  EXPECT_EQ(faces_built(), 1);
  expect_whole("shards, then a run over all");
}

TEST_F(Resume, LeftoversOfAKilledRunAreRemoved) {
  for (const char* name : {"out/.crowdface-17-0.tmp", "out/meshes/.crowdface-9999999-3.tmp",
                           "out/renders/.crowdface-1-1.tmp", "out/.crowdface.lock"}) {
    folder_.folder().write(name, "half");
  }
  run();
  expect_whole("leftovers removed");
}

// They were removed for their names.
TEST_F(Resume, PicturesOfTheUsersAmongSheetsAreKept) {
  folder_.folder().write("out/sheets/family_photo.png", "mine");
  remake_sheets(folder_.out(), {"output.contact_sheet.cell=40"}, folder_.cache());
  EXPECT_EQ(testing::read_text(folder_.out() / "sheets/family_photo.png"), "mine");
  const auto recorded = testing::read_text(folder_.out() / "ledger.jsonl");
  EXPECT_EQ(recorded.find("photo"), recorded.npos);
  ConfigOverrides other;
  other.seed = "12";
  generate(folder_.config(), other, {folder_.cache(), Replace::kForce, false});
  EXPECT_EQ(testing::read_text(folder_.out() / "sheets/family_photo.png"), "mine");
}

TEST_F(Resume, SheetsOfACrowdWithoutFacesAreNone) {
  ConfigOverrides none;
  none.count = "0";
  generate(folder_.config(), none, {folder_.cache(), Replace::kForce, false});
  EXPECT_NO_THROW(remake_sheets(folder_.out(), {}, folder_.cache()));
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
}

TEST_F(Resume, AnotherConfigReplacesLedgerAndAll) {
  ConfigOverrides other;
  other.seed = "12";
  generate(folder_.config(), other, {folder_.cache(), Replace::kForce, false});
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
  run({}, Replace::kForce);
  expect_whole("and back");
}

}  // namespace
}  // namespace crowdface
