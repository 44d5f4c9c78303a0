// SPDX-License-Identifier: Apache-2.0
// Contact sheets of a whole crowd, and what the gallery leaves in its folder.
#include "crowdface/pictures/sheets.h"

#include <chrono>

#include <gmock/gmock.h>

#include "crowdface/core/file.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/likeness_file.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/io/image.h"
#include "crowdface/pictures/sheet_labels.h"
#include "crowdface/render/contact_sheet.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

std::vector<FacePlan> three_faces() {
  std::vector<FacePlan> crowd(3);
  crowd[0].id = "mob_smith_01";
  crowd[0].family = "smith";
  crowd[1].id = "mob_jones_01";
  crowd[1].family = "jones";
  crowd[2].id = "mob_0001";
  crowd[2].notes.nearest = NearestNeighbours{1, 2.345, std::nullopt, 0};
  return crowd;
}

Likeness three_likeness() {
  return {{2, 0, 1}, {{{2, 1.5}}, {{0, 3.25}}, {{0, 1.5}, {1, 4}}}};
}

TEST(SheetOrder, FamiliesStandTogetherAndThoseOfNoneLast) {
  EXPECT_THAT(sheet_order(SheetOrder::kPlan, three_faces(), three_likeness()),
              ElementsAre(0, 1, 2));
  EXPECT_THAT(sheet_order(SheetOrder::kFamily, three_faces(), three_likeness()),
              ElementsAre(1, 0, 2));
  EXPECT_THAT(sheet_order(SheetOrder::kLikeness, three_faces(), three_likeness()),
              ElementsAre(2, 0, 1));
}

TEST(SheetLabel, HasALineForEachThingAskedFor) {
  using L = SheetLabel;
  const std::vector<std::string> heads = {"ann", "bob"};
  const std::vector<std::vector<std::string>> tags = {{"female", "old"}, {}};
  EXPECT_EQ(sheet_label({L::kId, L::kTarget, L::kNearest, L::kNearestHead}, three_faces(), 2,
                        three_likeness(), heads, tags),
            "mob_0001\non ann\nnear mob_smith_01, 1.50 mm\nnear bob, 2.35 mm");
  EXPECT_EQ(sheet_label({L::kFamily, L::kId}, three_faces(), 0, three_likeness(), heads, tags),
            "family smith\nmob_smith_01");
  // Lines stay where they are where there is nothing to say.
  EXPECT_EQ(sheet_label({L::kFamily, L::kId}, three_faces(), 2, three_likeness(), heads, tags),
            "\nmob_0001");
  std::vector<FacePlan> dressed = three_faces();
  dressed[1].attachments = {"bob", "round"};
  EXPECT_EQ(sheet_label({L::kTags, L::kAttachments}, dressed, 1, three_likeness(), heads, tags),
            "female, old\nbob, round");
}

// With bands a child has more parts than there are regions: names beyond the last region's were
// read.
TEST(InheritanceLabel, TellsRegionsAndWhereParentsShareOneItsBands) {
  FacePlan child;
  child.id = "mob_smith_03";
  child.mother_share = 0.4;
  child.inherited_from = {"mother", "father"};
  EXPECT_EQ(inheritance_label(child, {{"ann"}, {"top", "bottom"}, {}}),
            "mob_smith_03\nform 40 % mother\nmother: top\nfather: bottom");
  child.inherited_from = {"mother", "father", "father", "father"};
  const PlanNames banded{{"ann"}, {"top", "bottom"}, {"build", "skin"}};
  EXPECT_EQ(inheritance_label(child, banded),
            "mob_smith_03\nform 40 % mother\nmother: top/build\nfather: top/skin, bottom");
  child.inherited_from.pop_back();
  EXPECT_THROW(inheritance_label(child, banded), BrokenPrecondition);
}

// A plan holds four decimals: sheets made anew from it said 32.31 where the run had said 32.32.
TEST(SheetLabel, SaysTheSameOfARunAndOfItsPlan) {
  std::vector<FacePlan> crowd = three_faces();
  crowd[2].notes.nearest->head_distance_mm = 32.31499996;
  const std::string of_run =
      sheet_label({SheetLabel::kNearestHead}, crowd, 2, three_likeness(), {"ann", "bob"}, {});
  crowd[2].notes.nearest->head_distance_mm = 32.315;
  EXPECT_EQ(of_run, sheet_label({SheetLabel::kNearestHead}, crowd, 2, three_likeness(),
                                {"ann", "bob"}, {}));
}

TEST(LikenessFile, ReadsBackWhatWasWritten) {
  const testing::TemporaryFolder folder;
  const PlanNames names{{"ann", "bob"}, {"all"}};
  const std::vector<std::string> ids = {"a", "b", "c"};
  const CrowdLikeness likeness{{{0, 1}, {-0.25, 0.5}}, three_likeness()};
  const fs::path path =
      folder.write("likeness.json", whole_text(likeness_text(likeness, names, ids)));
  const CrowdLikeness read = read_likeness(path, names, ids);
  EXPECT_EQ(read.anchors[1], likeness.anchors[1]);
  EXPECT_EQ(read.likeness.face_order, likeness.likeness.face_order);
  EXPECT_EQ(read.likeness.neighbours[2][1].face, 1U);
  EXPECT_EQ(read.likeness.neighbours[2][1].distance_mm, 4);
  testing::expect_error(ExitCode::kBadData, {"likeness.json"}, [&] {
    read_likeness(path, names, {"a", "b", "d"});
  });
}

int height_of(const fs::path& picture) {
  return read_image(picture).height;
}

int width_of(const fs::path& picture) {
  return read_image(picture).width;
}

TEST(Sheets, HeadsFamiliesAndAnIndexStandBesideTheFaces) {
  SmallCrowd crowd;
  crowd.count = 5;
  crowd.contact_sheet =
      "{columns: 2, rows: 1, cell: 48, labels: [id, nearest], order: likeness, "
      "formats: [png, exr, pdf]}";
  crowd.more = "believability: none\nfamilies: [{name: kin, members: 2, max_distance: 30 mm}]\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const fs::path sheets = folder.out() / "sheets";
  for (const char* name : {"sheet_001.png", "sheet_004.png", "heads_001.png", "family_kin.png",
                           "index.png", "sheet_001.exr", "family_kin.exr", "sheets.pdf"}) {
    EXPECT_TRUE(fs::exists(sheets / name)) << name;
  }
  EXPECT_FALSE(fs::exists(sheets / "sheet_005.png"));
  for (const std::string& head : folder.names()) {
    EXPECT_TRUE(fs::exists(folder.out() / "renders/heads" / (head + ".png"))) << head;
  }
  EXPECT_TRUE(fs::exists(folder.out() / "renders/founders/kin.png"));
  // Founder and two members.
  EXPECT_GT(width_of(sheets / "family_kin.png"),
            width_of(folder.out() / "renders/founders/kin.png"));
  EXPECT_THAT(read_file(sheets / "sheets.pdf"), HasSubstr("/Count 7"));
}

// The index of a large crowd was too large, after all faces were made, and after every other run.
TEST(Sheets, ManyPagesHaveSeveralIndicesAndBooks) {
  SmallCrowd crowd;
  crowd.count = 67;
  crowd.contact_sheet = "{columns: 1, rows: 1, cell: 32, formats: [png, pdf]}";
  crowd.more = "believability: none\nfamilies: [{name: kin, members: 2, max_distance: 30 mm}]\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const fs::path sheets = folder.out() / "sheets";
  for (const char* name : {"index_001.png", "index_002.png", "sheets_001.pdf", "sheets_002.pdf",
                           "sheet_069.png", "heads_001.png", "family_kin.png"}) {
    EXPECT_TRUE(fs::exists(sheets / name)) << name;
  }
  EXPECT_FALSE(fs::exists(sheets / "index.png"));
  EXPECT_FALSE(fs::exists(sheets / "index_003.png"));
  EXPECT_THAT(read_file(sheets / "sheets_001.pdf"), HasSubstr("/Count 65"));
  EXPECT_THAT(read_file(sheets / "sheets_002.pdf"), HasSubstr("/Count 8"));
  EXPECT_TRUE(verify_crowd(folder.out()).is_intact());
  folder.folder().write("out/sheets/index_of_cast.png", "mine");
  folder.folder().write("out/sheets/sheets_for_us.pdf", "mine");
  remake_sheets(folder.out(), {"output.contact_sheet.rows=4"}, folder.cache());
  EXPECT_TRUE(fs::exists(sheets / "index_of_cast.png"));
  EXPECT_TRUE(fs::exists(sheets / "sheets_for_us.pdf"));
  EXPECT_TRUE(fs::exists(sheets / "index.png"));
  EXPECT_FALSE(fs::exists(sheets / "index_002.png"));
  EXPECT_FALSE(fs::exists(sheets / "sheets_002.pdf"));
}

TEST(Sheets, PagesThatAreTooLargeAreRefusedWithTheConfig) {
  const SmallCrowdFolder folder(SmallCrowd{});
  const auto load = [&](const std::string& sheet) {
    Problems problems;
    ConfigOverrides overrides;
    overrides.assignments = {"output.contact_sheet=" + sheet};
    load_job(folder.config(), overrides, {}, problems);
    return problems.messages();
  };
  EXPECT_THAT(load("{columns: 10, rows: 1, cell: 2048, views: [front, three_quarter, profile]}"),
              ::testing::IsEmpty());
  for (const char* sheet :
       {"{columns: 11, rows: 1, cell: 2048, views: [front, three_quarter, profile]}",
        "{columns: 8, rows: 1, cell: 2048, views: [front, three_quarter, profile], compare: "
        "target}",
        "{columns: 1, rows: 32, cell: 2048}", "{columns: 12, rows: 12, cell: 2048}"}) {
    ASSERT_EQ(load(sheet).size(), 1U) << sheet;
    EXPECT_THAT(load(sheet)[0], HasSubstr("too large")) << sheet;
  }
}

// What is checked before the work is what is made after it.
TEST(Sheets, CellsAreAsWideAsIsReckoned) {
  SmallCrowd crowd;
  crowd.count = 2;
  crowd.contact_sheet =
      "{columns: 2, rows: 1, cell: 64, views: [front, profile], compare: target, labels: [id]}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const SheetLayout layout =
      layout_sheet(CellSize{3 * 64, 64, 2}, 2,
                   {.columns = 2, .rows = 0, .title = "t", .legend = HeatLegend{}, .note = {}});
  EXPECT_EQ(width_of(folder.out() / "sheets/sheet_001.png"), layout.width());
  EXPECT_EQ(height_of(folder.out() / "sheets/sheet_001.png"), layout.height());
}

TEST(Sheets, MadeAnewShowFoundersInTheNewForm) {
  SmallCrowd crowd;
  crowd.count = 2;
  crowd.contact_sheet = "{columns: 2, cell: 48}";
  crowd.more = "believability: none\nfamilies: [{name: kin, members: 2, max_distance: 30 mm}]\n";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const fs::path founder = folder.out() / "renders/founders/kin.png";
  const std::string generated = read_file(founder);
  fs::remove(founder);
  remake_sheets(folder.out(), {}, folder.cache());
  EXPECT_EQ(read_file(founder), generated);
  remake_sheets(folder.out(), {"output.contact_sheet.cell=64"}, folder.cache());
  EXPECT_EQ(width_of(founder), 64);
  // Founder and two members, two cells of 64 pixels a row.
  EXPECT_GT(height_of(folder.out() / "sheets/family_kin.png"), 2 * 64);
}

TEST(Sheets, MadeAnewTheyTakePicturesThatAreAsTheyShouldBe) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 2, cell: 48}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const fs::path kept = folder.out() / "renders/mob_0001.png",
                 damaged = folder.out() / "renders/mob_0002.png";
  const std::string whole = read_file(damaged);
  const auto drawn = fs::last_write_time(kept) - std::chrono::hours(1);
  fs::last_write_time(kept, drawn);
  write_file(damaged, whole.substr(0, whole.size() / 2));
  remake_sheets(folder.out(), {"output.contact_sheet.columns=3"}, folder.cache());
  EXPECT_EQ(fs::last_write_time(kept), drawn);
  EXPECT_EQ(read_file(damaged), whole);
  remake_sheets(folder.out(), {"output.contact_sheet.cell=64"}, folder.cache());
  EXPECT_EQ(width_of(kept), 64);
  remake_sheets(folder.out(), {}, folder.cache());
  EXPECT_EQ(width_of(kept), 48);
}

TEST(Sheets, AnotherFormLeavesNothingOfTheOldOne) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 1, rows: 1, cell: 48, formats: [png, pdf]}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  EXPECT_TRUE(fs::exists(folder.out() / "sheets/sheet_004.png"));
  remake_sheets(folder.out(), {"output.contact_sheet.columns=2", "output.contact_sheet.rows=2",
                               "output.contact_sheet.formats=[png]"});
  EXPECT_TRUE(fs::exists(folder.out() / "sheets/sheet_001.png"));
  EXPECT_FALSE(fs::exists(folder.out() / "sheets/sheet_002.png"));
  EXPECT_FALSE(fs::exists(folder.out() / "sheets/sheets.pdf"));
}

TEST(Sheets, MadeAnewTheyAreVerifiedAndGivenBackAsTheConfigHasThem) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 2, rows: 2, cell: 48}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const fs::path sheet = folder.out() / "sheets/sheet_001.png";
  const std::string before = read_file(sheet);
  for (const char* change : {"output.contact_sheet.columns=1", "output.contact_sheet.cell=64"}) {
    remake_sheets(folder.out(), {change});
    EXPECT_NE(read_file(sheet), before) << change;
    EXPECT_TRUE(verify_crowd(folder.out()).is_intact()) << change;
    run(folder);
    EXPECT_EQ(read_file(sheet), before) << change;
    EXPECT_TRUE(verify_crowd(folder.out()).is_intact()) << change;
  }
}

TEST(Sheets, CompareShowsADistanceMapBesideEachFace) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 2, rows: 2, cell: 48, compare: target}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  const fs::path sheet = folder.out() / "sheets/sheet_001.png";
  const int with = width_of(sheet);
  for (const char* other : {"nearest", "none"}) {
    remake_sheets(folder.out(), {concat("output.contact_sheet.compare=", other)});
    EXPECT_EQ(width_of(sheet) == with, std::string(other) == "nearest") << other;
  }
  // Against itself, a crowd is blue all over: largest distance 0.
  remake_sheets(folder.out(), {concat("output.contact_sheet.compare=", folder.out().string())});
  EXPECT_EQ(width_of(sheet), with);
  testing::expect_error(ExitCode::kMissingInput, {"nowhere"}, [&] {
    remake_sheets(folder.out(), {"output.contact_sheet.compare=nowhere"});
  });
}

TEST(Sheets, WhatTheyCompareWithIsCheckedBeforeTheWork) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 2, rows: 2, cell: 48, compare: other.obj}";
  const SmallCrowdFolder folder(crowd);
  const auto refused = [&](ExitCode code, const std::string& phrase) {
    testing::expect_error(code, {phrase}, [&] { run(folder); });
    EXPECT_FALSE(fs::exists(folder.out()));
  };
  folder.folder().write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refused(ExitCode::kBadData, "found 3");
  fs::remove(folder / "other.obj");
  fs::create_directory(folder / "other.obj");
  refused(ExitCode::kMissingInput, "mob_0001");
  fs::create_symlink("meshes", folder / "other.obj/meshes");  // a circle
  refused(ExitCode::kMissingInput, "cannot be read");
}

TEST(Sheets, FollowTheDistanceMask) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 2, rows: 2, cell: 48}";
  crowd.more = "distance: {mask: seen.png}\nbelievability: none\n";
  const SmallCrowdFolder folder(crowd);
  const auto made = [&](std::uint32_t seed) {
    testing::write_mask(folder / "seen.png", testing::mask_picture(13, 9, seed), false);
    run(folder);
    return testing::crowd_files(folder.out());
  };
  const auto first = made(1);
  const auto second = made(2);
  EXPECT_NE(first.at("likeness.json"), second.at("likeness.json"));
  fs::remove_all(folder.out());
  EXPECT_THAT(testing::differing_files(second, made(2)), ::testing::IsEmpty());
}

TEST(Sheets, ReplacingACrowdRemovesItsPictures) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 1, rows: 1, cell: 48, formats: [png, exr, pdf]}";
  const SmallCrowdFolder folder(crowd);
  run(folder);
  run(folder, {"output.contact_sheet=none"}, Replace::kForce);
  for (const char* left : {"sheets", "renders", "gallery", "likeness.json"}) {
    EXPECT_FALSE(fs::exists(folder.out() / left)) << left;
  }
}

}  // namespace
}  // namespace crowdface
