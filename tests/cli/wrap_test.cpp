// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

#include "cli/program_test.h"
#include "support/crowd_files.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

/// Synthetic heads, and landmarks that are the same vertices on each.
class Wrap : public ::testing::Test {
 protected:
  void SetUp() override {
    crowdface(0, {"synth", "-o", heads_.string(), "--count", "3", "--vertices", "5000", "--quiet"});
    fs::create_directories(scans_);
    landmarks_ =
        folder_.write("landmarks.yaml", concat("template: ", kPlaces, "\nscan: ", kPlaces));
  }
  std::vector<std::string> single(const fs::path& landmarks, const fs::path& out) const {
    return {"wrap", head(1).string(), head(2).string(), "--landmarks", landmarks.string(),
            "-o",   out.string()};
  }
  fs::path head(int i) const { return heads_ / concat("synth_0", i, ".obj"); }

  static constexpr const char* kPlaces =
      "{a: 400, b: 900, c: 1500, d: 2100, e: 2700, f: 3300, g: 3900}";
  /// Landmarks on lips and corners of the mouth, and places on the chin below them, as a user picks
  /// them who takes one for the other.
  static constexpr const char* kOnMouth = ", u: 3670, l: 3652, r: 3625, s: 3589}";
  static constexpr const char* kOnChin =
      ", u: [0, -9.06, 9.07], l: [0, -10.4, 9.1], r: [3.4, -9.6, 7.8], s: [3.7, -9.6, 7.6]}";
  TemporaryFolder folder_;
  fs::path heads_ = folder_ / "heads", scans_ = folder_ / "scans", landmarks_;
};

TEST_F(Wrap, GivesTheTemplatesFileWithOtherPositionsAReportAndAPicture) {
  const fs::path out = folder_ / "head.obj";
  crowdface(0, single(landmarks_, out), {"7 landmarks", "mm from the scan"});
  expect_same_but_positions(head(1), out);
  EXPECT_EQ(read_file(folder_ / "head.wrap.png").substr(1, 3), "PNG");
  const std::string report = read_file(folder_ / "head.wrap.json");
  EXPECT_THAT(report, ::testing::HasSubstr("\"flipped_triangles\": 0"));
  EXPECT_THAT(report, ::testing::HasSubstr("\"name\": \"g\""));
  EXPECT_THAT(report, ::testing::ContainsRegex(
                          "\"regions_mm\": [{]\n *\"brow\": [{]\n *\"median\": [0-9]"));
  EXPECT_THAT(report, ::testing::HasSubstr("\"left_out_mm\": "));
  EXPECT_THAT(report, ::testing::Not(::testing::HasSubstr("unseen_mm")));
}

/// Lids that are fitted to eyeballs lie over the eyes.
TEST_F(Wrap, EyeballsAndTeethOfAScanHaveNoEffect) {
  const fs::path out = folder_ / "head.obj";
  crowdface(0, single(landmarks_, out));
  const std::string with_eyeballs = read_file(out), scan = read_file(head(2));
  const std::size_t eyeballs = scan.find("usemtl eyeball_left");
  ASSERT_NE(eyeballs, std::string::npos);
  folder_.write("heads/synth_02.obj", scan.substr(0, eyeballs));
  crowdface(0, single(landmarks_, out));
  EXPECT_EQ(read_file(out), with_eyeballs);
}

TEST_F(Wrap, EstimatesHowWellPlacesCorrespondWhereAskedTo) {
  const fs::path out = folder_ / "head.obj";
  auto command = single(landmarks_, out);
  command.emplace_back("--estimate");
  crowdface(0, command, {"7 landmarks"});
  const std::string report = read_file(folder_ / "head.wrap.json");
  EXPECT_THAT(report, ::testing::ContainsRegex("\"correspondence_mm\": [{]\n *\"median\": [0-9]"));
  EXPECT_THAT(report, ::testing::HasSubstr("\"unseen_mm\": "));
}

TEST_F(Wrap, ABatchGoesOnWhereItStoppedAndPastWhatIsNoScan) {
  for (int i = 2; i <= 3; ++i) {
    fs::copy(head(i), scans_ / concat("person_", i, ".obj"));
    folder_.write(concat("scans/person_", i, ".yaml"), concat("scan: ", kPlaces));
  }
  const std::vector<std::string> batch = {
      "wrap",           "--batch",      scans_.string(),     "--template",
      head(1).string(), "--landmarks",  landmarks_.string(), "-o",
      folder_ / "out",  "--no-pictures"};
  auto dry = batch;
  dry.emplace_back("--dry-run");
  crowdface(0, dry, {"person_2.obj", "7 landmarks", "would be wrapped to"});
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  folder_.write("scans/broken.ply", "ply\n");
  crowdface(65, batch, {"broken.ply", "header has no end"});
  const std::string first = read_file(folder_ / "out/person_2.obj");
  EXPECT_TRUE(fs::exists(folder_ / "out/reports/person_3.wrap.json"));
  fs::remove(scans_ / "broken.ply");
  fs::remove(folder_ / "out/person_3.obj");
  crowdface(0, batch, {"1 of 2 scans are already wrapped"});
  EXPECT_EQ(read_file(folder_ / "out/person_2.obj"), first);
  EXPECT_TRUE(fs::exists(folder_ / "out/person_3.obj"));
}

TEST_F(Wrap, ABatchReadsLandmarksInEachFormatAndNoHiddenFiles) {
  const std::string rows = "a,400\nb,900\nc,1500\nd,2100\ne,2700\nf,3300\ng,3900\n";
  const std::string json =
      "{\"a\":400,\"b\":900,\"c\":1500,\"d\":2100,\"e\":2700,\"f\":3300,\"g\":3900}";
  fs::copy(head(2), scans_ / "table.obj");
  fs::copy(head(2), scans_ / "list.obj");
  fs::copy(head(2), scans_ / "short.obj");
  fs::copy(head(2), scans_ / "array.obj");
  const std::string header = "{'descr': '<i1', 'fortran_order': False, 'shape': (2,)}\n";
  folder_.write("scans/array.npy", std::string("\x93NUMPY\x01\0", 8) +
                                       static_cast<char>(header.size()) + '\0' + header + "ab");
  folder_.write("scans/table.csv", rows);
  folder_.write("scans/list.json", json);
  folder_.write("scans/short.yml", concat("scan: ", kPlaces));
  folder_.write("scans/._table.obj", std::string("\0\5\x16\7", 4));
  fs::copy(head(2), scans_ / "notes.obj");
  folder_.write("scans/notes.txt", "scanned on a Monday\n");
  folder_.write("scans/notes.json", "{\"camera\": \"left\"}\n");
  const std::string said =
      crowdface(0, {"wrap", "--batch", scans_.string(), "--template", head(1).string(),
                    "--landmarks", landmarks_.string(), "-o", folder_ / "out", "--dry-run"})
          .err;
  for (const char* scan : {"table.obj", "list.obj", "short.obj"}) {
    EXPECT_THAT(said, ::testing::ContainsRegex(concat(scan, ": [0-9]+ triangles, 7 landmarks")));
  }
  EXPECT_THAT(said, ::testing::HasSubstr("array.obj: "));
  EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr("array.npy: ")));
  EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr("._table")));
  EXPECT_THAT(said, ::testing::ContainsRegex("notes.txt.*the file is not used"));
  EXPECT_THAT(said, ::testing::ContainsRegex("notes.json.*the file is not used"));
}

// `wrap` gave heads names that `init` and `generate` refuse.
TEST_F(Wrap, ABatchGivesHeadsNamesThatACrowdTakes) {
  const auto dry_run = [&](int code, std::initializer_list<std::string> words) {
    return crowdface(code,
                     {"wrap", "--batch", scans_.string(), "--template", head(1).string(),
                      "--landmarks", landmarks_.string(), "-o", folder_ / "out", "--dry-run"},
                     words)
        .err;
  };
  fs::copy(head(2), scans_ / "Jos\u00e9 Mu\u0308ller (2).obj");
  folder_.write("scans/Jos\u00e9 Mu\u0308ller (2).csv",
                "a,400\nb,900\nc,1500\nd,2100\ne,2700\nf,3300\ng,3900\n");
  const std::string said = dry_run(0, {"its head is called \"Jose_Muller__2_\"", "7 landmarks"});
  EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr("synth_02.obj: its head")));
  fs::copy(head(2), scans_ / "all.obj");
  fs::copy(head(2), scans_ / "Jose Muller [2].ply");
  dry_run(64, {"cannot have the name \"all\"", "wrapped to the same head, \"Jose_Muller__2_\""});
}

TEST_F(Wrap, ShardsShareABatchAndThePageShowsTheMostDoubtfulFirst) {
  for (int i = 2; i <= 3; ++i) {
    fs::copy(head(i), scans_ / concat("person_", i, ".obj"));
    folder_.write(concat("scans/person_", i, ".yaml"), concat("scan: ", kPlaces));
  }
  const auto shard = [&](const std::string& part) {
    return std::vector<std::string>{
        "wrap",           "--batch",       scans_.string(),     "--template",
        head(1).string(), "--landmarks",   landmarks_.string(), "-o",
        folder_ / "out",  "--no-pictures", "--shard",           part};
  };
  crowdface(0, shard("2/2"));
  EXPECT_FALSE(fs::exists(folder_ / "out/person_2.obj"));
  EXPECT_TRUE(fs::exists(folder_ / "out/person_3.obj"));
  std::string page = read_file(folder_ / "out/reports/index.html");
  EXPECT_LT(page.find("<h2>person_2.obj</h2>\n<p>No head."), page.find("<h2>person_3.obj"));
  crowdface(0, shard("1/2"));
  EXPECT_TRUE(fs::exists(folder_ / "out/person_2.obj"));
  // The report decides the order: the doubtful head is first.
  const fs::path report = folder_ / "out/reports/person_3.wrap.json";
  std::string text = read_file(report);
  const std::size_t mouth = text.find("\"mouth\": ", text.find("\"features\"")) + 9;
  text.replace(mouth, text.find_first_of(",\n", mouth) - mouth, "0.31");
  folder_.write("out/reports/person_3.wrap.json", text);
  crowdface(0, shard("1/2"));
  page = read_file(folder_ / "out/reports/index.html");
  EXPECT_LT(page.find("person_3.obj"), page.find("person_2.obj"));
  EXPECT_THAT(page, ::testing::HasSubstr("Least agreement: mouth, 0.31"));
  crowdface(64, shard("3/2"), {"--shard"});
}

TEST_F(Wrap, RefusalsSayWhatToDo) {
  const fs::path out = folder_ / "head.obj";
  const auto with = [&](const char* name, const std::string& text) {
    return single(folder_.write(name, text), out);
  };
  std::string sheet;  // a bent sheet, which has no face
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 20; ++k) sheet += concat("v ", i, " ", k, " ", 0.01 * i * i, "\n");
  }
  for (int i = 0; i < 19; ++i) {
    for (int k = 1; k < 20; ++k) {
      const int a = 20 * i + k;
      sheet += concat("f ", a, " ", a + 1, " ", a + 21, " ", a + 20, "\n");
    }
  }
  crowdface(65,
            {"wrap", head(1).string(), folder_.write("sheet.obj", sheet).string(), "--landmarks",
             folder_.write("few.yaml", "template: {a: 1, b: 2}\nscan: {a: 1, b: 2}\n").string(),
             "-o", out.string()},
            {"at least 4", "--scan-up", "found 2"});
  crowdface(64, with("beyond.yaml", "template:\n  a: 99999999\nscan: {a: 1}\n"),
            {"beyond.yaml:2:6", "vertex of the template", "99999999"});
  crowdface(64, with("flat.yaml", "template: {a: 1}\nscan:\n  a: [1, 2]\n"),
            {"flat.yaml:3", "[x, y, z]"});
  crowdface(64, with("key.yaml", "templates: {a: 1}\n"), {"key.yaml:1", "templates"});
  crowdface(66, single(folder_ / "none.yaml", out), {"none.yaml"});
  crowdface(64, {"wrap", head(1).string(), "-o", out.string()}, {"TEMPLATE.obj and SCAN"});
  crowdface(64, {"wrap", "--batch", scans_.string(), "-o", out.string()}, {"--template"});
  auto units = single(landmarks_, out);
  units.insert(units.end(), {"--scan-units", "furlong"});
  crowdface(64, units, {"furlong", "mm, cm, m, in, ft, or a length"});
  units.back() = "m";
  crowdface(64, units, {"times as large as the template; expected cm, or none"});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Wrap, AFaceThatTheReliefShowsNeedsNoLandmarks) {
  const fs::path out = folder_ / "head.obj";
  const auto run = crowdface(0, {"wrap", head(1).string(), head(2).string(), "-o", out.string()});
  EXPECT_THAT(run.err, ::testing::HasSubstr("a face that looks along +Z with +Y up"));
  EXPECT_TRUE(fs::exists(out));
}

TEST_F(Wrap, StrictWritesNoHeadWhoseMouthIsDoubtful) {
  const std::string places = std::string(kPlaces).substr(0, std::string(kPlaces).size() - 1);
  const std::string strayed = folder_.write(
      "strayed.yaml", concat("template: ", places, kOnMouth, "\nscan: ", places, kOnChin));
  const fs::path out = folder_ / "head.obj";
  auto command = single(strayed, out);
  crowdface(0, command, {"the mouth is doubtful", "head.obj, "});
  EXPECT_THAT(read_file(folder_ / "head.wrap.json"), ::testing::HasSubstr("\"mouth\": -"));
  fs::remove(out);
  fs::remove(folder_ / "head.wrap.png");
  command.emplace_back("--strict");
  crowdface(65, command, {"--strict: the mouth is doubtful"});
  EXPECT_FALSE(fs::exists(out));
  EXPECT_TRUE(fs::exists(folder_ / "head.wrap.png"));
  crowdface(0,
            {"wrap", head(1).string(), head(1).string(), "--landmarks", landmarks_.string(), "-o",
             out.string(), "--strict"},
            {"head.obj, "});
}

TEST_F(Wrap, ASingleWrapSaysThatItUsesLandmarksBesideTheScan) {
  fs::copy(head(2), scans_ / "person.obj");
  const std::string beside = folder_.write("scans/person.yaml", concat("scan: ", kPlaces));
  const std::string scan = (scans_ / "person.obj").string(), said = "uses the landmarks in ";
  const auto dry = [&](const std::string& landmarks) {
    std::vector<std::string> command = {"wrap", head(1).string(),    scan,
                                        "-o",   folder_ / "out.obj", "--dry-run"};
    if (!landmarks.empty()) command.insert(command.end(), {"--landmarks", landmarks});
    return crowdface(0, command).err;
  };
  EXPECT_THAT(dry(""), ::testing::HasSubstr(said + beside));
  EXPECT_THAT(dry(beside), ::testing::Not(::testing::HasSubstr(said)));
  EXPECT_THAT(dry("none"), ::testing::Not(::testing::HasSubstr(said)));
  // The file beside the scan took the place of the file that was given.
  EXPECT_THAT(dry(landmarks_.string()), ::testing::Not(::testing::HasSubstr(said)));
}

TEST_F(Wrap, NoneTurnsOffPickedAndDetectedLandmarks) {
  fs::copy(head(2), scans_ / "person.obj");
  folder_.write("scans/person.yaml", concat("scan: ", kPlaces));
  const fs::path out = folder_ / "head.obj";
  const std::string scan = (scans_ / "person.obj").string();
  const auto dry = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"wrap", head(1).string(), scan, "-o", out.string(), "--dry-run"});
    return crowdface(0, more).err;
  };
  EXPECT_THAT(dry({}), ::testing::HasSubstr("detected from the shape"));
  const std::string none = dry({"--landmarks", "none"});
  EXPECT_THAT(none, ::testing::HasSubstr(" 0 landmarks"));
  EXPECT_THAT(none, ::testing::Not(::testing::HasSubstr("detected from the shape")));
}

TEST_F(Wrap, BakesTexturesThatTheMaterialFileNames) {
  const fs::path coloured = folder_ / "coloured";
  crowdface(0, {"synth", "-o", coloured.string(), "--count", "2", "--vertices", "5000",
                "--textures", "128", "--quiet"});
  fs::create_directories(folder_ / "both");
  for (const char* name : {"synth_02.obj", "synth_02.mtl", "synth_02_albedo.png"}) {
    fs::copy(coloured / name, folder_ / "both" / name);
  }
  folder_.write("both/synth_02.yaml", concat("scan: ", kPlaces));
  const std::vector<std::string> batch = {"wrap",
                                          "--batch",
                                          (folder_ / "both").string(),
                                          "--template",
                                          (coloured / "synth_01.obj").string(),
                                          "--landmarks",
                                          landmarks_.string(),
                                          "-o",
                                          folder_ / "out",
                                          "--no-pictures",
                                          "--texture",
                                          "256"};
  crowdface(0, batch, {"synth_02.obj", "mm from the scan"});
  const std::string head = read_file(folder_ / "out/synth_02.obj");
  EXPECT_THAT(head, ::testing::HasSubstr("\nmtllib synth_02.mtl\n"));
  EXPECT_THAT(head, ::testing::Not(::testing::HasSubstr("synth_01.mtl")));
  const std::string materials = read_file(folder_ / "out/synth_02.mtl");
  EXPECT_THAT(materials,
              ::testing::HasSubstr("newmtl skin\nKd 1 1 1\nmap_Kd synth_02.colour.png\n"));
  EXPECT_TRUE(fs::exists(folder_ / "out/synth_01_roughness.png"));  // which the head keeps
  EXPECT_FALSE(fs::exists(folder_ / "out/synth_01_albedo.png"));
  EXPECT_TRUE(fs::exists(folder_ / "out/synth_02.colour.png"));
  EXPECT_THAT(read_file(folder_ / "out/reports/synth_02.wrap.json"),
              ::testing::HasSubstr("\"textures_filled\": 0."));
  // A missing texture, and a change of the scan's, are baked again; nothing else is.
  crowdface(0, batch, {"1 of 1 scans are already wrapped"});
  fs::remove(folder_ / "out/reports/synth_02.filled.png");
  crowdface(0, batch, {"mm from the scan"});
  EXPECT_TRUE(fs::exists(folder_ / "out/reports/synth_02.filled.png"));
  fs::copy_file(coloured / "synth_01_albedo.png", folder_ / "both/synth_02_albedo.png",
                fs::copy_options::overwrite_existing);
  crowdface(0, batch, {"mm from the scan"});
}

TEST_F(Wrap, RefusesTexturesOfScansWithoutColours) {
  auto command = single(landmarks_, folder_ / "head.obj");
  command.insert(command.end(), {"--texture", "64"});
  crowdface(65, command, {"synth_02.obj", "--texture", "a texture or colours at vertices"});
  EXPECT_FALSE(fs::exists(folder_ / "head.obj"));
  command.back() = "8";
  crowdface(64, command, {"--texture", "from 64 to 16384", "8"});
  command.resize(command.size() - 2);
  command.emplace_back("--delight");
  crowdface(64, command, {"--delight", "--texture"});
}

// The heads of a model, scans and template were replaced without a word.
TEST_F(Wrap, WritesOverNoneOfItsInputs) {
  fs::copy(head(2), scans_ / "synth_02.obj");
  const auto expect_refused = [&](const fs::path& input, const std::vector<std::string>& more,
                                  const fs::path& out) {
    const std::string before = read_file(input);
    std::vector<std::string> arguments = {"wrap", "--landmarks", landmarks_.string(), "-o",
                                          out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    crowdface(64, arguments, {input.filename().string(), "is an input"});
    EXPECT_EQ(read_file(input), before);
  };
  const std::vector<std::string> batch = {"--batch", scans_.string(), "--template"};
  const auto batch_of = [&](std::vector<std::string> more) {
    more.insert(more.begin(), batch.begin(), batch.end());
    return more;
  };
  expect_refused(scans_ / "synth_02.obj", batch_of({head(1).string()}), scans_);
  expect_refused(head(2), batch_of({head(2).string()}), heads_);
  expect_refused(head(2), batch_of({head(1).string(), "--model", heads_.string()}), heads_);
  expect_refused(head(3),
                 {head(1).string(), (scans_ / "synth_02.obj").string(), "--model", heads_.string()},
                 head(3));
  EXPECT_FALSE(fs::exists(heads_ / "reports"));
}

// A scan without area, or none that is a head, gave the template as it was, and was done.
TEST_F(Wrap, AScanThatShowsNothingOfTheSkinIsRefused) {
  const fs::path scan = folder_.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  crowdface(65,
            {"wrap", head(1).string(), scan.string(), "-o", folder_ / "head.obj", "--scan-up", "+Y",
             "--scan-front", "+Z"},
            {"one.obj", "has no data for the skin"});
  EXPECT_FALSE(fs::exists(folder_ / "head.obj"));
}

TEST_F(Wrap, WhatCannotBePickedOnIsRefusedBeforeThePageOpens) {
  const auto pick = [&](const fs::path& scan, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"wrap", "--pick", head(1).string(), scan.string(),
                                          "--no-browser"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const std::string file = (folder_ / "new.yaml").string();
  crowdface(64, pick(head(2), {}), {"--pick", "--landmarks FILE.yaml"});
  crowdface(64, pick(head(2), {"--landmarks", file, "-o", "x.obj"}),
            {"--pick wraps nothing", "--output"});
  crowdface(64, {"wrap", "--pick", "--batch", scans_.string(), "--landmarks", file},
            {"--batch", "--template TEMPLATE.obj"});
  crowdface(64, pick(head(2), {"--landmarks", head(2).string()}), {"ends in .yaml"});
  crowdface(64, pick(head(2), {"--landmarks", file, "--port", "99999"}), {"--port", "99999"});
  crowdface(66, pick(folder_ / "none.ply", {"--landmarks", file}), {"none.ply"});
  crowdface(65, pick(folder_.write("broken.ply", "ply\n"), {"--landmarks", file}),
            {"broken.ply", "header has no end"});
  const fs::path beyond = folder_.write("beyond.yaml", "template: {a: 1}\nscan: {b: 99999999}\n");
  crowdface(64, pick(head(2), {"--landmarks", beyond.string()}),
            {"beyond.yaml:2", "vertex of the scan"});
  crowdface(73, pick(head(2), {"--landmarks", (folder_ / "no/such.yaml").string()}), {"such.yaml"});
  EXPECT_FALSE(fs::exists(file));
  crowdface(64, {"wrap", head(1).string(), head(2).string()}, {"--output"});
}

}  // namespace
}  // namespace crowdface::testing
