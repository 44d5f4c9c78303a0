// SPDX-License-Identifier: Apache-2.0
// Test 19 of docs/reliability.md: an editor that is killed, or whose system calls fail, while a person works.
#include <csignal>
#include <fstream>
#include <random>
#include <thread>

#include <Eigen/Core>  // before httplib.h, whose headers of the system clang cannot read before Eigen's
#include <httplib.h>

#include "crowdface/core/text.h"
#include "crowdface/editor/edit.h"

#include "reliability/crowd_under_test.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Kind = Fault::Kind;
using ::testing::HasSubstr;

/// A crowd of two in a folder that is watched together with its config; heads, masks and cache stand elsewhere.
class DisturbedEditor : public ::testing::Test {
 public:
  DisturbedEditor() : folder_(small()) {
    encode_png(1, 1, 1, std::vector<std::uint8_t>(1));  // loads the library behind images
    std::string text = read_text(folder_.config());
    for (const std::string name : {"heads", "mask_0.png"}) {
      const std::size_t at = text.find(name);
      text.replace(at, name.size(), (folder_ / name).string());
    }
    config_text_ = text;
    fs::create_directories(watched());
    reset();
    const ChildOutcome made = run_with_fault(watched(), {}, [this] {
      generate(config(), {}, {folder_.cache(), Replace::kRefuse, false});
    });
    EXPECT_EQ(made.code, 0) << made.message;
    undisturbed_ = edit({}, &DisturbedEditor::work);
    EXPECT_EQ(undisturbed_.code, 0) << undisturbed_.message;
    EXPECT_EQ(confirmed().size(), 10U) << "of ten steps";
    for (const char* version : {"1", "2"}) {
      const auto kept = folder_ / concat("kept_", version);
      versions_[read_text(kept / "edited.jsonl")] = read_text(kept / "eva.obj");
    }
    EXPECT_EQ(versions_.size(), 2U);
  }

  static SmallCrowd small() {
    SmallCrowd crowd;
    crowd.regions = 2;
    crowd.levels = "basis";
    crowd.count = 2;
    return crowd;
  }
  fs::path watched() const { return folder_ / "watched"; }
  fs::path config() const { return watched() / "config.yaml"; }
  fs::path edited(const std::string& name) const { return watched() / "out/edited" / name; }

  /// As before the first editor.
  void reset() const {
    fs::remove_all(edited(""));
    fs::remove(watched() / "config_edits.yaml");
    fs::remove(folder_ / "confirmed");
    std::ofstream(config()) << config_text_;
  }
  /// What the page was told to be kept.
  std::set<std::string> confirmed() const {
    std::set<std::string> all;
    std::ifstream lines(folder_ / "confirmed");
    for (std::string line; std::getline(lines, line);) all.insert(line);
    return all;
  }

  /// A page in the editor's own process.
  class Page {
   public:
    Page(const DisturbedEditor& test, const std::string& address)
        : test_(test),
          host_(address.substr(0, address.find('/', 7))),
          path_(address.substr(host_.size())),
          client_(host_) {
      client_.set_read_timeout(std::chrono::seconds(60));
    }
    Json get(const std::string& what) {
      const auto answer = client_.Get(path_ + what);
      return answer ? Json::parse(answer->body, nullptr, false) : Json();
    }
    /// \param name  of the step, among those that are confirmed
    bool ask(const std::string& name, const std::string& method, const std::string& what,
             const Json& body) {
      const httplib::Headers headers = {{"Origin", host_}};
      const std::string json = "application/json";
      const auto answer = method == "PUT" ? client_.Put(path_ + what, headers, body.dump(), json)
                                          : client_.Post(path_ + what, headers, body.dump(), json);
      if (!answer || answer->status != 200) return false;
      std::ofstream(test_.folder_ / "confirmed", std::ios::app) << name << std::endl;
      return true;
    }
    void mark(const std::string& id) {
      ask("mark " + id, "POST", "api/review",
          {{"id", id}, {"verdict", "keep"}, {"note", "of " + id}});
    }

   private:
    const DisturbedEditor& test_;
    std::string host_, path_;
    httplib::Client client_;
  };

  /// All that a person does; what could not be done does not keep from the rest.
  void work(Page& page) const {
    Json recipe = page.get("api/job");
    recipe = recipe.is_object() ? recipe["start"] : Json();
    recipe["id"] = "eva";
    for (const char* version : {"1", "2"}) {
      recipe["target"] = folder_.names()[version[0] - '0'];
      const bool saved = page.ask(concat("save ", version), "POST", "api/save",
                                  {{"recipe", recipe}, {"format", "obj"}});
      const auto kept = folder_ / concat("kept_", version);
      if (saved && !fs::exists(kept)) fs::copy(edited(""), kept);
      page.ask(concat("state ", version), "PUT", "api/state", {{"step", version}});
    }
    page.mark("mob_0001");
    page.ask("recipe", "POST", "api/recipes", {{"recipe", recipe}});
    for (const char* number : {"0.1", "0.2", "0.3"}) {
      page.ask(concat("stroke ", number), "POST", "api/masks/stroke",
               {{"region", "region_1"},
                {"mode", "paint"},
                {"radius_mm", 5},
                {"strength", std::stod(number)},
                {"falloff", 0.5},
                {"begin", true},
                {"points", {{{"triangle", 0}, {"u", 0.3}, {"v", 0.3}}}}});
    }
    page.ask("state 3", "PUT", "api/state", {{"step", "3"}});
  }
  void second_mark(Page& page) const { page.mark("mob_0002"); }
  void replace_masks(Page& page) const {
    page.ask("masks", "POST", "api/regions", {{"add", "cheek"}});
  }

  ChildOutcome edit(const Fault& fault, void (DisturbedEditor::*use)(Page&) const) const {
    return run_with_fault(watched(), fault, [&] {
      catch_interrupts();
      std::thread person;
      EditOptions options;
      options.cache = CacheFolder{folder_.cache()};
      const auto started = [&](const std::string& address) {
        person = std::thread([this, use, address] {
          Page page(*this, address);
          (this->*use)(page);
          ::kill(::getpid(), SIGTERM);
        });
      };
      const ThreadLimit limit(2);
      try {
        crowdface::edit(config(), {}, options, started);
      } catch (...) {
        if (person.joinable()) person.join();
        throw;
      }
      person.join();
    });
  }

  /// Whatever was confirmed is there, and mesh and recipe agree.
  void expect_kept(const std::string& after) const {
    const std::set<std::string> told = confirmed();
    const auto text = [&](const fs::path& file) { return fs::exists(file) ? read_text(file) : ""; };
    const std::string recipe = text(edited("edited.jsonl"));
    if (!recipe.empty()) {
      ASSERT_TRUE(versions_.contains(recipe)) << after << ": " << recipe;
      EXPECT_EQ(text(edited("eva.obj")) == versions_.at(recipe), true)
          << "another mesh after " << after;
    } else {
      EXPECT_FALSE(fs::exists(edited("eva.obj"))) << "a mesh without its recipe after " << after;
    }
    for (const char* version : {"1", "2"}) {
      if (!told.contains(concat("save ", version))) continue;
      EXPECT_FALSE(recipe.empty()) << after;
      const auto kept = read_text(folder_ / concat("kept_", version) / "edited.jsonl");
      EXPECT_TRUE(recipe == kept || version[0] == '1') << "an older recipe after " << after;
    }
    const std::string state = text(edited("state.json"));
    for (const char* step : {"1", "2", "3"}) {
      if (!told.contains(concat("state ", step))) continue;
      const auto kept = Json::parse(state, nullptr, false);
      ASSERT_TRUE(kept.is_object()) << "state after " << after;
      EXPECT_GE(kept["step"].get<std::string>(), step) << after;
    }
    for (const char* id : {"mob_0001", "mob_0002"}) {
      if (!told.contains(concat("mark ", id))) continue;
      EXPECT_THAT(text(edited("review.yaml")), HasSubstr("of " + std::string(id))) << after;
    }
    if (told.contains("recipe")) {
      EXPECT_THAT(text(watched() / "config_edits.yaml"), HasSubstr("- {id: eva")) << after;
      EXPECT_THAT(read_text(config()), HasSubstr("edits: ")) << after;
    }
    EXPECT_THAT(read_text(config()), ::testing::StartsWith(config_text_)) << after;
    if (told.contains("masks")) {
      EXPECT_THAT(text(watched() / "config_edits.yaml"), HasSubstr("cheek")) << after;
      return;
    }
    for (const char* number : {"0.1", "0.2", "0.3"}) {
      if (!told.contains(concat("stroke ", number))) continue;
      EXPECT_THAT(text(edited("strokes.jsonl")), HasSubstr(concat("\"strength\":", number)))
          << after;
    }
  }

  /// The next editors open what a disturbed one left, and what was confirmed outlives them all.
  void expect_goes_on(const std::string& after) const {
    const ChildOutcome next = edit({}, &DisturbedEditor::second_mark);
    EXPECT_EQ(next.code, 0) << after << ": " << next.message;
    EXPECT_TRUE(confirmed().contains("mark mob_0002")) << after;
    expect_kept(after);
    for (const auto& entry : fs::directory_iterator(edited(""))) {
      EXPECT_FALSE(entry.path().filename().string().starts_with("."))
          << entry << " after " << after;
    }
    const ChildOutcome last = edit({}, &DisturbedEditor::replace_masks);
    EXPECT_EQ(last.code, 0) << after << ": " << last.message;
    EXPECT_TRUE(confirmed().contains("masks")) << after;
    expect_kept(after);
  }

  SmallCrowdFolder folder_;
  std::string config_text_;
  ChildOutcome undisturbed_;
  std::map<std::string, std::string> versions_;  ///< the mesh of each line of edited.jsonl
};

TEST_F(DisturbedEditor, KilledAtAnyCallItKeepsWhatWasConfirmed) {
  RecordProperty("calls", static_cast<int>(undisturbed_.calls));
  std::mt19937 random(7);
  constexpr Kind kKinds[] = {Kind::kKillBefore, Kind::kKillWithin, Kind::kKillAfter};
  for (int i = 0; i < times(40, 1000); ++i) {
    const Fault fault{kKinds[i % 3], random() % undisturbed_.calls, 0};
    reset();
    const ChildOutcome outcome = edit(fault, &DisturbedEditor::work);
    EXPECT_EQ(outcome.code, outcome.struck ? -SIGKILL : 0) << fault.at << ' ' << outcome.message;
    expect_goes_on(concat("a kill at call ", fault.at, ", kind ", i % 3));
  }
}

TEST_F(DisturbedEditor, OneFailedCallLosesNothingThatWasConfirmed) {
  std::mt19937 random(8);
  const std::uint64_t step = undisturbed_.calls / static_cast<std::uint64_t>(times(
                                                      40, static_cast<int>(undisturbed_.calls)));
  for (std::uint64_t call = random() % step; call < undisturbed_.calls; call += step) {
    reset();
    const ChildOutcome outcome =
        edit({Kind::kFail, call, call % 2 == 0 ? EIO : ENOSPC}, &DisturbedEditor::work);
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 73 || outcome.code == 74 || outcome.code == 66)
        << call << ": " << outcome.code << ' ' << outcome.message;
    expect_goes_on(concat("a failure of call ", call));
  }
}

}  // namespace
}  // namespace crowdface::testing
