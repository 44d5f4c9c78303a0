// SPDX-License-Identifier: Apache-2.0
// Tests 20 and 21 of docs/reliability.md: each file that a job reads gives its place to a pipe, or changes.
#include <fstream>

#include <sys/stat.h>

#include "crowdface/core/text.h"

#include "reliability/crowd_under_test.h"
#include "support/program.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

/// A crowd with an input of every kind.
class InputsOfAJob : public ::testing::Test {
 protected:
  InputsOfAJob()
      : folder_([] {
          SmallCrowd crowd;
          crowd.bowl.materials = true;
          crowd.regions = 2;
          crowd.levels = "basis";
          crowd.count = 2;
          crowd.contact_sheet = "{columns: 2, rows: 1, cell: 32}";
          crowd.more =
              "points: points.yaml\nshapes: {neutral: heads/ann.obj, directory: shapes}\n"
              "review: marks.yaml\nedits: edits.yaml\n"
              "attachments: {fitted_to: ann, items: [{name: rod, kind: glasses, "
              "file: wear/rod.obj, moves: rigid}]}\n";
          return crowd;
        }()) {
    const TemporaryFolder& folder = folder_.folder();
    folder.write("points.yaml", "template: heads/ann.obj\npoints: {jaw: [0.5, -1, 0.25]}\n");
    folder.write("shapes/other.obj", bowl_text(folder_.crowd().bowl, 40));
    folder.write("marks.yaml", "schema: 1\nfaces: {mob_0001: reject}\n");
    folder.write("edits.yaml",
                 "recipes: [{id: eva, target: ann, regions: {region_1: {iterations: 2, weights: "
                 "{bob: 1}}, region_2: {iterations: 1, weights: {bob: 1}}}}]\n");
    for (std::size_t h = 0; h < folder_.names().size(); ++h) {
      const std::string& name = folder_.names()[h];
      std::string text = read_text(folder_.head(name));
      folder.write(concat("heads/", name, ".obj"),
                   text.replace(text.find("bowl.mtl"), 8, name + ".mtl"));
      folder.write(
          concat("heads/", name, ".mtl"),
          concat("newmtl skin\nKd 1 1 1\nmap_Kd maps/", name, ".png\nmap_bump maps/bump.png\n",
                 "newmtl eye\nKd 1 1 1\nmap_d maps/eye.png\n"));
      folder.write(concat("heads/maps/", name, ".png"), grey_png(60 + 40 * static_cast<int>(h)));
    }
    for (const char* map : {"heads/maps/bump.png", "heads/maps/eye.png", "wear/rod.png"}) {
      folder.write(map, grey_png(255));
    }
    folder.write("wear/rod.mtl", "newmtl rod\nKd 1 1 1\nmap_Kd rod.png\n");
    folder.write("wear/rod.obj",
                 "mtllib rod.mtl\nv 0 0 1\nv 1 0 1\nv 0 1 1.5\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl "
                 "rod\nf 1/1 2/2 3/3\n");
    folder.write("landmarks.yaml",
                 "template: {a: 1, b: 20, c: 40, d: 60, e: 80, f: 99}\n"
                 "scan: {a: 1, b: 20, c: 40, d: 60, e: 80, f: 99}\n");
  }
  static std::string grey_png(int grey) {
    return encode_png(16, 16, 1, std::vector<std::uint8_t>(256, static_cast<std::uint8_t>(grey)));
  }
  /// 124 if it has not ended after some time.
  Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"30", CROWDFACE_PROGRAM});
    return run_program("/usr/bin/timeout", arguments);
  }
  std::vector<std::string> command(const std::string& name, const fs::path& of) const {
    return {name, of.string(), "-q", "--cache", folder_.cache().string()};
  }
  std::vector<fs::path> files(const fs::path& below) const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(below)) {
      if (entry.is_regular_file()) found.push_back(entry.path());
    }
    return found;
  }
  /// Whether a file is an input of the crowd's.
  bool leads_to(const fs::path& file) const {
    const fs::path way = fs::relative(file, folder_.folder().path());
    const std::string folder = way.begin()->string();
    return folder != "out" && folder != "cache" && folder != "fresh" && way != "landmarks.yaml" &&
           way != "config.yaml" && way != "marks.yaml";  // reviews add up
  }
  /// Another text or picture that is good in the file's place.
  std::string changed_text(const fs::path& file, const std::string& text) const {
    const std::string ending = file.extension();
    if (file == folder_ / "mask_0.png") {
      write_mask(folder_ / "other.png", mask_picture(13, 9, 77));
      std::string other = read_text(folder_ / "other.png");
      fs::remove(folder_ / "other.png");
      return other;
    }
    if (ending == ".png") return grey_png(30);
    const std::map<std::string, std::pair<std::string, std::string>> changes = {
        {"points.yaml", {"0.25", "0.35"}},

        {"edits.yaml", {"iterations: 2", "iterations: 3"}},
        {".mtl", {"Kd 1 1 1", "Kd 1 0.5 1"}},
        {"rod.obj", {"1.5", "1.25"}}};
    for (const auto& [name, change] : changes) {
      if (!file.string().ends_with(name)) continue;
      std::string other = text;
      return other.replace(text.find(change.first), change.first.size(), change.second);
    }
    std::string other = bowl_text(folder_.crowd().bowl, 60);
    return other.replace(other.find("bowl.mtl"), 8, file.stem().string() + ".mtl");
  }
  /// Expects the command to end, by itself, with a pipe in place of the file.
  void expect_ends(const fs::path& file, const std::vector<std::string>& arguments,
                   const std::set<int>& codes) const {
    fs::rename(file, folder_ / "aside");
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    const Outcome outcome = run(arguments);
    EXPECT_TRUE(codes.contains(outcome.code)) << arguments.front() << " with a pipe for " << file
                                              << ": " << outcome.code << ' ' << outcome.err;
    fs::remove(file);
    fs::rename(folder_ / "aside", file);
  }

  SmallCrowdFolder folder_;
};

// A points file, a review and landmarks were waited for without end.
TEST_F(InputsOfAJob, ThatArePipesAreRefused) {
  auto generate = command("generate", folder_.config());
  generate.emplace_back("--dry-run");
  const Outcome whole = run(generate);
  ASSERT_EQ(whole.code, 0) << whole.err;
  for (const fs::path& file : files(folder_.folder().path())) {
    if (file == folder_ / "landmarks.yaml") continue;
    const std::string ending = file.extension();
    const bool may_be_missing = ending == ".mtl" || ending == ".png" || ending == ".cfcache";
    expect_ends(file, generate, may_be_missing ? std::set{0, 64, 65, 66} : std::set{64, 65, 66});
    fs::remove_all(folder_.out());
  }
  const std::vector<std::string> wrap = {"wrap",
                                         folder_.head("ann"),
                                         folder_.head("bob"),
                                         "--landmarks",
                                         folder_ / "landmarks.yaml",
                                         "-o",
                                         folder_ / "wrapped.obj"};
  for (const fs::path& file :
       {folder_ / "landmarks.yaml", folder_.head("ann"), folder_.head("bob")}) {
    expect_ends(file, wrap, {64, 65, 66});
  }
  EXPECT_FALSE(fs::exists(folder_.out()));
}

// One planted in the crowd's folder stopped each run, status and verify too.
TEST_F(InputsOfAJob, PipesInACrowdsFolderStopNoCommand) {
  const Outcome made = run(command("generate", folder_.config()));
  ASSERT_EQ(made.code, 0) << made.err;
  for (const fs::path& file : files(folder_.out())) {
    const fs::path place = fs::relative(file, folder_.out());
    const bool is_face =
        place.begin()->string() == "meshes" || place.begin()->string() == "gallery";
    if (is_face && place.string().find("mob_0001") == std::string::npos) continue;
    for (const char* name : {"generate", "sheet", "verify", "status", "gather"}) {
      const fs::path& of = name == std::string("generate") ? folder_.config() : folder_.out();
      auto arguments = command(name, of);
      const bool has_cache = name != std::string("verify") && name != std::string("status");
      if (!has_cache) arguments.resize(3);
      expect_ends(file, arguments, {0, 64, 65, 66, 73, 74});
      if (is_face) break;
    }
  }
}

// Another colour in a head's material file changed nothing, and the faces' own materials kept the old one.
TEST_F(InputsOfAJob, ThatChangeMakeTheCrowdAnew) {
  const auto generate = [&](const char* out, bool force) {
    auto arguments = command("generate", folder_.config());
    arguments.insert(arguments.end(),
                     {"--out", folder_ / out, "--set", "output.meshes=[obj, glb, usd]"});
    if (force) arguments.emplace_back("--force");
    return run(arguments);
  };
  const Outcome made = generate("out", false);
  ASSERT_EQ(made.code, 0) << made.err;
  std::size_t changed = 0;
  for (const fs::path& file : files(folder_.folder().path())) {
    if (!leads_to(file)) continue;
    const std::string before = read_text(file);
    std::ofstream(file, std::ios::binary) << changed_text(file, before);
    fs::remove_all(folder_ / "fresh");
    ASSERT_EQ(generate("fresh", false).code, 0) << file;
    Outcome outcome = generate("out", false);
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 64) << file << outcome.err;
    if (outcome.code == 64) outcome = generate("out", true);
    EXPECT_EQ(outcome.code, 0) << file << outcome.err;
    EXPECT_THAT(differing_files(crowd_files(folder_ / "fresh"), crowd_files(folder_.out())),
                ::testing::IsEmpty())
        << "after a change of " << file;
    std::ofstream(file, std::ios::binary) << before;
    outcome = generate("out", true);
    EXPECT_EQ(outcome.code, 0) << file << outcome.err;
    ++changed;
  }
  EXPECT_GE(changed, 20U);
}

}  // namespace
}  // namespace crowdface::testing
