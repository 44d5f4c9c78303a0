// SPDX-License-Identifier: Apache-2.0
// Reviews stay in a crowd's folder and in effect, whatever else of the config changes.
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/generate.h"

#include "support/bowl_heads.h"
#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::crowd_files;
using testing::differing_files;
using ::testing::IsEmpty;
using testing::plan_lines;
using testing::run;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

SmallCrowd dressed() {
  SmallCrowd crowd;
  crowd.heads = 6;
  crowd.regions = 2;
  crowd.count = 6;
  crowd.contact_sheet = "{columns: 3, rows: 1, cell: 32}";
  return crowd;
}

class KeptReviews : public ::testing::Test {
 protected:
  KeptReviews() : folder_(dressed()) {
    for (const char* file : {"index.html", "gallery.js", "gallery.css", "three.LICENSE.txt"}) {
      folder_.folder().write(concat("page/", file), file);
    }
    ::setenv("CROWDFACE_GALLERY", (folder_ / "page").c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    run(folder_);
    first_ = plan_lines(folder_.out());
    review("a.yaml", "{mob_0002: reject, mob_0003: {mark: keep, note: good}}");
    reviewed_ = plan_lines(folder_.out());
  }

  ~KeptReviews() override {
    ::unsetenv("CROWDFACE_GALLERY");  // NOLINT(concurrency-mt-unsafe)
  }

  ConfigOverrides with_review(const std::string& name, const std::string& faces) const {
    ConfigOverrides overrides;
    overrides.review = {folder_.folder().write(name, "schema: 1\nfaces: " + faces + "\n").string()};
    return overrides;
  }
  void review(const std::string& name, const std::string& faces,
              const std::vector<std::string>& set = {}) const {
    ConfigOverrides overrides = with_review(name, faces);
    overrides.assignments = set;
    run(folder_, overrides);
  }
  fs::path out(const std::string& name) const { return folder_.out() / name; }
  std::string kept() const { return testing::read_text(out("reviews/review_001.yaml")); }

  SmallCrowdFolder folder_;
  std::vector<json> first_, reviewed_;
};

TEST_F(KeptReviews, ForceKeepsThemAndAppliesThem) {
  ASSERT_NE(first_[1], reviewed_[1]);
  const std::string text = kept();
  folder_.folder().write("out/edited/review.yaml", "mine");
  run(folder_, {"smoothing.boundary=free"}, Replace::kForce);
  EXPECT_EQ(kept(), text);
  EXPECT_EQ(testing::read_text(out("edited/review.yaml")), "mine");
  ConfigOverrides overrides{{"smoothing.boundary=free"}, {}, {}, {}};
  overrides.review = {(folder_ / "a.yaml").string()};
  testing::run_to(folder_, "again", overrides);
  EXPECT_EQ(plan_lines(folder_.out()), plan_lines(folder_ / "again"));
  EXPECT_TRUE(fs::exists(out("rejected.jsonl")));
}

TEST_F(KeptReviews, ForceStartsWithoutThemOnlyIfAskedTo) {
  ConfigOverrides overrides{{"crowd.seed=12"}, {}, {}, {}};
  overrides.without_reviews = true;
  run(folder_, overrides, Replace::kForce);
  EXPECT_FALSE(fs::exists(out("reviews")));
  int aside = 0;
  for (const auto& [name, text] : crowd_files(folder_.out())) {
    aside +=
        name.starts_with("reviews-") && text.starts_with("schema: 1\nfaces: {mob_0002: reject");
  }
  EXPECT_EQ(aside, 1);
  testing::run_to(folder_, "again", ConfigOverrides{{"crowd.seed=12"}, {}, {}, {}});
  EXPECT_EQ(plan_lines(folder_.out()), plan_lines(folder_ / "again"));
}

TEST_F(KeptReviews, ReviewsThatNoLongerFitAreToldAndKept) {
  review("b.yaml", "{mob_0006: reject}");
  const auto before = crowd_files(folder_.out());
  testing::expect_error(ExitCode::kUsage, {"review_002.yaml", "mob_0006", "--without-reviews"},
                        [&] {
                          run(folder_, {"crowd.count=3", "crowd.seed=12"}, Replace::kForce);
                        });
  EXPECT_THAT(differing_files(before, crowd_files(folder_.out())), IsEmpty());
}

// From the folder's own config, too, which names the reviews.
TEST_F(KeptReviews, OfTheSameCrowdAreSetAsideOnlyIfAskedTo) {
  ConfigOverrides overrides;
  overrides.without_reviews = true;
  generate(out("config.yaml"), overrides, {folder_.cache(), Replace::kRefuse, false});
  EXPECT_EQ(plan_lines(folder_.out()), first_);
  EXPECT_FALSE(fs::exists(out("reviews")));
  run(folder_);
  EXPECT_EQ(plan_lines(folder_.out()), first_);
}

// A review of an older version does not state the count of its crowd.
TEST_F(KeptReviews, OfAnOlderVersionKeepTheirFaces) {
  folder_.folder().write("out/reviews/review_001.yaml", testing::read_text(folder_ / "a.yaml"));
  run(folder_, {"crowd.count=12"});
  const auto lines = plan_lines(folder_.out());
  for (std::size_t i = 0; i < reviewed_.size(); ++i) EXPECT_EQ(lines[i], reviewed_[i]);
}

TEST_F(KeptReviews, WhatDoesNotDecideWhoTheFacesAreMayChange) {
  for (const char* set :
       {"output.meshes=[obj, ply]", "output.contact_sheet.columns=2", "output.lods=[50 %]",
        "textures.size=64", "output.contact_sheet=none", "output.meshes=[points]"}) {
    run(folder_, {set});
    EXPECT_EQ(plan_lines(folder_.out()), reviewed_) << set;
  }
}

/// Whether a file depends on every key of the config, and so may change with any.
bool is_about_the_run(const std::string& name) {
  return name == "config.yaml" || name == "report.json" || name == "ledger.jsonl" ||
         name.starts_with("sheets/") || name.starts_with("gallery/data/");
}

// Of each kind of keys: the finished crowd gets the files of a run from nothing, its plan stays,
// and every file that the key does not concern keeps its bytes. Without the key, all is as before.
TEST_F(KeptReviews, EachKindOfKeysThatDecideNothingMayChange) {
  const testing::TemporaryFolder& files = folder_.folder();
  const std::string triangle = "v 0 0 1\nv 1 0 1\nv 0 1 1.5\nf 1 2 3\n";
  files.write("hat.obj", triangle);
  files.write("other_hat.obj", "v 0 0 1\nv 2 0 1\nv 0 1 1.5\nf 1 2 3\n");
  files.write("shapes/other.obj", testing::bowl_text(folder_.crowd().bowl, 40));
  files.write("points.yaml", "template: heads/ann.obj\npoints: {jaw: [0.5, -1, 0.25]}\n");
  SmallCrowd crowd = dressed();
  crowd.more = "\nattachments: {fitted_to: ann, items: [{name: hat, kind: hat, file: hat.obj}]}\n";
  folder_.configure(crowd);
  run(folder_, std::vector<std::string>(), Replace::kForce);
  const auto plain = crowd_files(folder_.out());
  const std::vector<json> lines = plan_lines(folder_.out());
  ASSERT_EQ(lines[1].at("regions"), reviewed_[1].at("regions"));
  struct Change {
    const char* set;
    const char* makes;    ///< a file that the key adds, or empty
    const char* touches;  ///< what the names of the files contain that the key may change
  };
  const Change changes[] = {
      {"output.meshes=[obj, glb]", "meshes/mob_0002.glb", ".glb"},
      {"output.lods=[50 %]", "meshes/mob_0002+LOD1.obj", "+LOD1"},
      {"output.contact_sheet.cell=48", "", "renders/"},
      {"output.contact_sheet.columns=2", "", "sheets/"},
      {"output.contact_sheet.views=[front, profile]", "", "renders/"},
      {"output.contact_sheet.formats=[png, pdf]", "sheets/sheets.pdf", "sheets/"},
      {"output.contact_sheet.order=likeness", "", "sheets/"},
      {"output.subdivision=catmull_clark", "", ".usda"},
      {"textures.size=64", "", "blended"},
      {"textures.formats=[jpeg]", "", "blended"},
      {"textures.blend=target", "", "blended"},
      {"shapes={neutral: heads/ann.obj, directory: shapes}", "meshes/mob_0002+other.obj", "+other"},
      {"points=points.yaml", "meshes/mob_0002+points.json", "+points"},
      {"attachments.fitted_to=mean", "", "hat"},
      {"attachments={fitted_to: ann, items: [{name: hat, kind: hat, file: other_hat.obj}]}", "",
       "hat"},
      {"attachments={fitted_to: ann, items: [{name: hat, kind: hat, file: hat.obj, moves: rigid}]}",
       "", "hat"},
      {"output.gallery=none", "", "gallery/"}};
  const auto change = [&](const char* set, const char* makes, const char* touches) {
    SCOPED_TRACE(set);
    run(folder_, {set});
    EXPECT_EQ(plan_lines(folder_.out()), lines);
    const auto now = crowd_files(folder_.out());
    EXPECT_TRUE(*makes == '\0' || now.contains(makes));
    for (const std::string& name : differing_files(plain, now)) {
      const bool is_picture = name.starts_with("renders/");
      EXPECT_TRUE(is_about_the_run(name) || is_picture || name.find(touches) != name.npos) << name;
    }
    fs::remove_all(folder_ / "again");
    ConfigOverrides overrides{{set}, {}, {}, {}};
    overrides.review = {out("reviews/review_001.yaml").string()};
    testing::run_to(folder_, "again", overrides);
    EXPECT_THAT(differing_files(crowd_files(folder_ / "again"), now), IsEmpty());
  };
  for (const auto& [set, makes, touches] : changes) change(set, makes, touches);
  run(folder_);
  EXPECT_THAT(differing_files(plain, crowd_files(folder_.out())), IsEmpty());
  // Left out, it stays as it is.
  change("output.faces_per_folder=3", "meshes/001/mob_0004.obj", "");
}

TEST_F(KeptReviews, WithoutAGalleryItsFilesGoAndOthersInItsFolderStay) {
  const auto before = crowd_files(folder_.out());
  ASSERT_TRUE(before.contains("gallery/data/mesh.js"));
  folder_.folder().write("out/gallery/notes.txt", "mine");
  run(folder_, {"output.gallery=none"});
  std::vector<std::string> left;
  for (const auto& [name, bytes] : crowd_files(folder_.out())) {
    if (name.starts_with("gallery/")) left.push_back(name);
  }
  EXPECT_THAT(left, ::testing::ElementsAre("gallery/notes.txt"));
  run(folder_);
  fs::remove(out("gallery/notes.txt"));
  EXPECT_THAT(differing_files(before, crowd_files(folder_.out())), IsEmpty());
}

// A new format adds files to each face; the face's other files keep their bytes and their times.
TEST_F(KeptReviews, AnotherFormatLeavesEveryOtherFile) {
  const auto before = crowd_files(folder_.out());
  for (const auto& [name, bytes] : before) {
    fs::last_write_time(folder_.out() / name, fs::file_time_type());
  }
  run(folder_, {"output.meshes=[obj, ply]"});
  const auto after = crowd_files(folder_.out());
  for (const auto& [name, bytes] : before) {
    if (name == "config.yaml" || name == "report.json" || name == "ledger.jsonl") continue;
    EXPECT_TRUE(after.contains(name) && after.at(name) == bytes) << name;
    if (!name.starts_with("meshes/mob_") && !name.starts_with("meshes/blended/")) continue;
    EXPECT_EQ(fs::last_write_time(folder_.out() / name), fs::file_time_type()) << name;
  }
  EXPECT_TRUE(after.contains("meshes/mob_0002.ply"));
  SmallCrowdFolder& other = folder_;
  other.folder().write("b.yaml", kept());
  ConfigOverrides overrides{{"output.meshes=[obj, ply]"}, {}, {}, {}};
  overrides.review = {(folder_ / "b.yaml").string()};
  testing::run_to(folder_, "again", overrides);
  EXPECT_THAT(differing_files(crowd_files(folder_ / "again"), after), IsEmpty());
}

TEST_F(KeptReviews, ACrowdGrowsAndItsFacesStay) {
  const auto meshes = [&] {
    auto files = crowd_files(folder_.out());
    std::erase_if(files, [](const auto& file) { return !file.first.starts_with("meshes/"); });
    return files;
  };
  const auto before = meshes();
  run(folder_, {"crowd.count=24"});
  const auto lines = plan_lines(folder_.out());
  ASSERT_EQ(lines.size(), 24U);
  for (std::size_t i = 0; i < reviewed_.size(); ++i) EXPECT_EQ(lines[i], reviewed_[i]);
  const auto after = meshes();
  for (const auto& [name, bytes] : before) EXPECT_EQ(after.at(name), bytes) << name;

  // Rejected again in the larger crowd, and then the crowd grows once more.
  review("c.yaml", "{mob_0002: reject, mob_0020: reject}", {"crowd.count=24"});
  const auto second = plan_lines(folder_.out());
  EXPECT_NE(second[1], reviewed_[1]);
  run(folder_, {"crowd.count=30"});
  const auto third = plan_lines(folder_.out());
  for (std::size_t i = 0; i < second.size(); ++i) EXPECT_EQ(third[i], second[i]);

  // From nothing, with the kept reviews.
  ConfigOverrides overrides{{"crowd.count=30"}, {}, {}, {}};
  overrides.review = {out("reviews/review_001.yaml").string(),
                      out("reviews/review_002.yaml").string()};
  testing::run_to(folder_, "again", overrides);
  EXPECT_EQ(plan_lines(folder_ / "again"), third);
}

// The folder's own config, which names the kept reviews, grows as well.
TEST_F(KeptReviews, ACrowdGrowsFromItsKeptConfig) {
  ConfigOverrides overrides{{"crowd.count=12"}, {}, {}, {}};
  generate(out("config.yaml"), overrides, {folder_.cache(), Replace::kRefuse, false});
  const auto lines = plan_lines(folder_.out());
  ASSERT_EQ(lines.size(), 12U);
  for (std::size_t i = 0; i < reviewed_.size(); ++i) EXPECT_EQ(lines[i], reviewed_[i]);
}

// The advice was a smaller min_distance, which was then refused.
TEST_F(KeptReviews, AFullCrowdGrowsWithASmallerDistanceAndItsFacesStay) {
  const auto distance = [](double mm) {
    return concat("diversity.min_distance=", format_fixed(mm, 3), " mm");
  };
  const auto closest_mm = [&] {
    return testing::read_json(out("casting.json"))
        .at("distances")
        .at("between_faces_mm")
        .at("min")
        .get<double>();
  };
  const std::string full = distance(0.9 * closest_mm()), many = "crowd.count=60";
  run(folder_, {full}, Replace::kForce);
  const std::vector<json> six = plan_lines(folder_.out());
  const auto before = crowd_files(folder_.out());
  std::string told;
  try {
    run(folder_, {full, many});
  } catch (const Unsatisfiable& error) {
    told = error.what();
  }
  EXPECT_THAT(told, ::testing::HasSubstr("the 6 faces that exist stay as they are"));
  EXPECT_THAT(told, ::testing::Not(::testing::HasSubstr("more heads")));
  EXPECT_THAT(differing_files(before, crowd_files(folder_.out())), IsEmpty());
  const std::string advised = "diversity.min_distance: ";
  ASSERT_NE(told.find(advised), told.npos) << told;
  const double mm = std::stod(told.substr(told.find(advised) + advised.size()));
  const auto expect_same_start = [&](const std::vector<json>& faces) {
    const std::vector<json> lines = plan_lines(folder_.out());
    ASSERT_GE(lines.size(), faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) EXPECT_EQ(lines[i], faces[i]);
  };
  run(folder_, {distance(mm), many});
  expect_same_start(six);
  EXPECT_GE(closest_mm(), mm - 1e-4);

  // A review of the full crowd, and still nearer faces.
  review("b.yaml", "{mob_0003: reject}", {distance(mm), many});
  const std::vector<json> sixty = plan_lines(folder_.out());
  EXPECT_EQ(sixty.size(), 60U);
  EXPECT_NE(sixty[2], six[2]);
  run(folder_, {distance(0.7 * mm), many});
  expect_same_start(sixty);
  run(folder_, {distance(0.7 * mm), "crowd.count=70"});
  expect_same_start(sixty);
  const std::vector<json> seventy = plan_lines(folder_.out());
  EXPECT_EQ(seventy.size(), 70U);

  // From nothing, with the kept config.
  ConfigOverrides overrides;
  overrides.out = (folder_ / "again").string();
  generate(out("config.yaml"), overrides, {folder_.cache(), Replace::kRefuse, false});
  EXPECT_EQ(plan_lines(folder_ / "again"), seventy);
  testing::expect_error(ExitCode::kUsage, {"diversity.min_distance", "--force"}, [&] {
    run(folder_, {full, "crowd.count=70"});
  });
}

TEST_F(KeptReviews, WhatDecidesWhoTheFacesAreIsRefusedByName) {
  const auto before = crowd_files(folder_.out());
  testing::expect_error(
      ExitCode::kUsage, {"crowd.seed", "sampling.max_sources", "--out", "--force"}, [&] {
        run(folder_, {"crowd.seed=12", "sampling.max_sources=2", "output.meshes=[ply]"});
      });
  testing::expect_error(ExitCode::kUsage, {"crowd.count", "--out", "--force"},
                        [&] { run(folder_, {"crowd.count=5"}); });
  testing::expect_error(ExitCode::kUsage, {"diversity.mode", "--force"}, [&] {
    run(folder_, {"crowd.count=8", "diversity.mode=spread"});
  });
  EXPECT_THAT(differing_files(before, crowd_files(folder_.out())), IsEmpty());
}

TEST(PlannedCrowd, GetsItsFormatsLater) {
  const SmallCrowdFolder folder(dressed());
  plan(folder.config(), {}, {folder.cache(), Replace::kRefuse, false});
  const auto planned = plan_lines(folder.out());
  run(folder, {"output.meshes=[ply]"});
  EXPECT_EQ(plan_lines(folder.out()), planned);
  EXPECT_TRUE(fs::exists(folder.out() / "meshes/mob_0001.ply"));
}

// Machines of a farm require the plan; another format does not invalidate it.
TEST(PlannedCrowd, IsUsedByShardsWithOtherFormats) {
  const SmallCrowdFolder folder(dressed());
  GenerateOptions options{folder.cache(), Replace::kRefuse, false};
  plan(folder.config(), {}, options);
  ConfigOverrides overrides;
  overrides.assignments = {"output.meshes=[ply]", "output.contact_sheet=none"};
  options.plan_source = PlanSource::kFolder;
  options.shard = Shard{1, 2};
  generate(folder.config(), overrides, options);
  EXPECT_TRUE(fs::exists(folder.out() / "meshes/mob_0001.ply"));
  overrides.assignments.emplace_back("changes={mob_0001: {variant_of: mob_0002}}");
  testing::expect_error(ExitCode::kMissingInput, {"planned.json"},
                        [&] { generate(folder.config(), overrides, options); });
}

}  // namespace
}  // namespace crowdface
