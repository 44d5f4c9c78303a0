// SPDX-License-Identifier: Apache-2.0
// Tests 19, 24 and 25 of docs/reliability.md: an editor that is killed, or whose system calls fail, while a user
// works; two editors at a time; an editor among hostile clients.
#include <csignal>
#include <fstream>
#include <list>
#include <random>
#include <thread>

#include <Eigen/Core>  // before httplib.h, whose headers of the system clang cannot read before Eigen's
#include <httplib.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/edit.h"

#include "reliability/crowd_under_test.h"
#include "support/program.h"
#include "support/raw_client.h"

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
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("asked ")) all.insert(line);
    }
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
      std::ofstream log(test_.folder_ / "confirmed", std::ios::app);
      log << "asked " << name << std::endl;
      const auto answer = method == "PUT" ? client_.Put(path_ + what, headers, body.dump(), json)
                                          : client_.Post(path_ + what, headers, body.dump(), json);
      if (!answer || answer->status != 200) return false;
      log << name << std::endl;
      return true;
    }
    void mark(const std::string& id) { mark(id, "mark " + id, "of " + id); }
    void mark(const std::string& id, const std::string& name, const std::string& note) {
      ask(name, "POST", "api/review", {{"id", id}, {"verdict", "keep"}, {"note", note}});
    }
    void stroke(const std::string& name, double strength) {
      ask(name, "POST", "api/masks/stroke",
          {{"region", "region_1"},
           {"mode", "paint"},
           {"radius_mm", 5},
           {"strength", strength},
           {"falloff", 0.5},
           {"begin", true},
           {"points", {{{"triangle", 0}, {"u", 0.3}, {"v", 0.3}}}}});
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
      page.stroke(concat("stroke ", number), std::stod(number));
    }
    page.ask("state 3", "PUT", "api/state", {{"step", "3"}});
  }
  void second_mark(Page& page) const { page.mark("mob_0002"); }
  void replace_masks(Page& page) const {
    page.ask("masks", "POST", "api/regions", {{"add", "cheek"}});
  }

  /// Steps in random order, each with a value that no other step has.
  void work_at_random(Page& page, unsigned seed) const {
    std::mt19937 random(seed);
    Json recipe = page.get("api/job");
    recipe = recipe.is_object() ? recipe["start"] : Json();
    for (int step = 0; step < 12; ++step) {
      const std::string value = concat("0.", 10000 + random() % 90000, "7");
      const std::string id = random() % 2 == 0 ? "eva" : "ada";
      switch (random() % 10) {
        case 0:  // late, because recipes cannot be saved from then on
          if (step >= 8) page.stroke("stroke " + value, std::stod(value));
          break;
        case 1:
          page.ask("masks", "POST", "api/masks/save", Json::object());
          break;
        case 2:
        case 3:
          page.ask("state " + value, "PUT", "api/state", {{"step", value}});
          break;
        case 4:
        case 5:
        case 6: {
          const std::string face = random() % 2 == 0 ? "mob_0001" : "mob_0002";
          page.mark(face, concat("mark ", face, ' ', value), value);
          break;
        }
        default:
          if (!recipe.is_object()) break;
          recipe["id"] = id;
          recipe["regions"]["region_1"]["extrapolation"] = std::stod(value);
          if (random() % 3 == 0) {
            page.ask(concat("recipe ", id, ' ', value), "POST", "api/recipes",
                     {{"recipe", recipe}});
          } else {
            page.ask(concat("save ", id, ' ', value), "POST", "api/save",
                     {{"recipe", recipe}, {"format", "obj"}});
          }
      }
    }
  }
  /// Expects that a file contains the last confirmed value of a kind of step, or a later one.
  void expect_last(const fs::path& file, const std::string& kind, const std::string& after) const {
    std::set<std::string> values;
    bool is_confirmed = false;
    std::ifstream lines(folder_ / "confirmed");
    for (std::string line; std::getline(lines, line);) {
      const bool is_asked = line.starts_with("asked ");
      const std::string name = line.substr(is_asked ? 6 : 0);
      if (!name.starts_with(kind + ' ')) continue;
      if (!is_asked) values.clear();
      is_confirmed = is_confirmed || !is_asked;
      values.insert(name.substr(kind.size() + 1));
    }
    if (!is_confirmed) return;
    const std::string text = fs::exists(file) ? read_text(file) : "";
    EXPECT_TRUE(std::ranges::any_of(
        values, [&](const auto& value) { return text.find(value) != text.npos; }))
        << kind << " after " << after << ": " << file << '\n'
        << text;
  }
  /// Expects what `work_at_random` was told to be saved.
  void expect_last_values(const std::string& after) const {
    expect_last(edited("state.json"), "state", after);
    for (const std::string id : {"mob_0001", "mob_0002"}) {
      expect_last(edited("review.yaml"), "mark " + id, after);
    }
    for (const std::string id : {"eva", "ada"}) {
      expect_last(watched() / "config_edits.yaml", "recipe " + id, after);
      expect_last(edited("edited.jsonl"), "save " + id, after);
      const fs::path mesh = edited(id + ".obj"), again = folder_ / "again.obj";
      if (!fs::exists(mesh)) continue;
      const Outcome blended =
          run_program(CROWDFACE_PROGRAM, {"blend", config(), "--recipe",
                                          concat(edited("edited.jsonl").string(), '#', id), "-o",
                                          again, "--cache", folder_.cache()});
      EXPECT_EQ(blended.code, 0) << blended.err;
      EXPECT_TRUE(read_text(mesh) == read_text(again)) << id << " after " << after;
    }
    for (const std::string& name : confirmed()) {
      if (!name.starts_with("stroke ")) continue;
      EXPECT_THAT(read_text(edited("strokes.jsonl")), HasSubstr(name.substr(7))) << after;
    }
  }

  static constexpr uid_t kNobody = 65534;
  static void become_nobody() {
    if (::geteuid() != 0) return;
    if (::setgid(kNobody) != 0 || ::setuid(kNobody) != 0) throw IoError("cannot be nobody");
  }

  using Use = std::function<void(const DisturbedEditor&, Page&)>;
  /// An editor and its user. Waits as long as another editor has the crowd.
  Child editor(const Fault& fault, const Use& use) const {
    return {fault, [this, use] {
              catch_interrupts();
              std::thread person;
              EditOptions options;
              options.cache = CacheFolder{folder_.cache()};
              const auto started = [&](const std::string& address) {
                person = std::thread([this, use, address] {
                  Page page(*this, address);
                  use(*this, page);
                  ::kill(::getpid(), SIGTERM);
                });
              };
              const ThreadLimit limit(2);
              for (;;) {
                try {
                  crowdface::edit(config(), {}, options, started);
                  break;
                } catch (const UsageError& error) {
                  if (std::string(error.what()).find("is already running") == std::string::npos)
                    throw;
                  std::this_thread::sleep_for(std::chrono::milliseconds(10));
                } catch (...) {
                  if (person.joinable()) person.join();
                  throw;
                }
              }
              person.join();
            }};
  }
  ChildOutcome edit(const Fault& fault, const Use& use) const {
    return run_together(watched(), {editor(fault, use)}).front();
  }

  /// Whatever was confirmed is there, and mesh and recipe agree.
  void expect_kept(const std::string& after) const {
    const std::set<std::string> told = confirmed();
    const auto text = [&](const fs::path& file) { return fs::exists(file) ? read_text(file) : ""; };
    const std::string recipe = text(edited("edited.jsonl"));
    if (!recipe.empty()) {
      ASSERT_TRUE(versions_.contains(recipe))
          << after << ": " << recipe << " instead of " << versions_.begin()->first;
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

TEST_F(DisturbedEditor, TwoEditorsLoseNothingThatWasConfirmedIfOneIsKilled) {
  const auto person = [](unsigned number) {
    return [number](const DisturbedEditor& test, Page& page) { test.work_at_random(page, number); };
  };
  reset();
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(edit({}, person(1)).code, 0);
  const std::chrono::duration<double, std::milli> whole = std::chrono::steady_clock::now() - start;
  std::mt19937 random(9);
  int killed = 0;
  for (int i = 0; i < times(6, 400); ++i) {
    reset();
    const unsigned seed = static_cast<unsigned>(random());
    const std::chrono::milliseconds life(random() % static_cast<unsigned>(whole.count()));
    Child mortal = editor({}, person(seed));
    mortal.work = [work = mortal.work, life] {
      std::thread([life] {
        std::this_thread::sleep_for(life);
        ::kill(::getpid(), SIGKILL);
      }).detach();
      work();
    };
    const auto outcomes = run_together(watched(), {mortal, editor({}, person(seed + 1))});
    killed += outcomes[0].code == -SIGKILL ? 1 : 0;
    const std::string after = concat("round ", i, ", a kill after ", life.count(), " ms");
    EXPECT_EQ(outcomes[1].code, 0) << after << ": " << outcomes[1].message;
    EXPECT_EQ(edit({}, [](const DisturbedEditor&, Page&) {}).code, 0) << after;
    expect_last_values(after);
  }
  EXPECT_GT(killed, 0);
}

// The crowd's folder has another name for a while, and all processes except the test are another user's.
TEST_F(DisturbedEditor, ServesItsUserAmongHostileClients) {
  const auto hand_over = [](const fs::path& path) {
    return ::geteuid() != 0 || ::lchown(path.c_str(), kNobody, kNobody) == 0;
  };
  ASSERT_TRUE(hand_over(folder_.folder().path()));
  for (const auto& entry : fs::recursive_directory_iterator(folder_.folder().path())) {
    ASSERT_TRUE(hand_over(entry.path()));
  }
  const auto flood = [this](unsigned seed) {
    return Child{{}, [this, seed] {
                   become_nobody();
                   std::mt19937 random(seed);
                   std::string address;
                   for (int tries = 0; tries < 3000 && address.empty(); ++tries) {
                     std::this_thread::sleep_for(std::chrono::milliseconds(10));
                     address = read_text(edited(".address"));
                   }
                   const std::size_t slash = address.find('/', 7);
                   const std::string host = address.substr(7, slash - 7);
                   const std::string good =
                       concat("POST ", address.substr(slash), "api/state HTTP/1.1\r\nHost: ", host,
                              "\r\nOrigin: http://", host, "\r\nContent-Length: 3\r\n\r\n[1]");
                   std::list<RawClient> clients;
                   while (clients.empty() || clients.back().connected()) {
                     if (clients.size() > 40) clients.pop_front();
                     std::string request = good.substr(0, 1 + random() % good.size());
                     for (std::size_t k = random() % 4; k > 0; --k) {
                       request[random() % request.size()] = static_cast<char>(random());
                     }
                     clients.emplace_back(std::stoi(host.substr(host.find(':') + 1))).say(request);
                   }
                 }};
  };
  for (int i = 0; i < times(1, 30); ++i) {
    reset();
    const auto use = [i](const DisturbedEditor& test, Page& page) {
      test.work(page);
      EXPECT_EQ(test.confirmed().size(), 10U);
      const fs::path out = test.watched() / "out", moved = test.watched() / "moved";
      fs::rename(out, moved);
      EXPECT_FALSE(page.ask("state 4", "PUT", "api/state", {{"step", "4"}}));
      EXPECT_FALSE(page.ask("mark again", "POST", "api/review", {{"id", "mob_0001"}}));
      EXPECT_FALSE(fs::exists(out));
      fs::rename(moved, out);
      test.work_at_random(page, static_cast<unsigned>(i));
    };
    Child served = editor({}, use);
    served.work = [work = served.work] {
      become_nobody();
      work();
      if (::testing::Test::HasFailure()) throw IoError("the user was not served");
    };
    const auto seed = static_cast<unsigned>(3 * i);
    const auto outcomes =
        run_together(watched(), {served, flood(seed), flood(seed + 1), flood(seed + 2)});
    EXPECT_EQ(outcomes[0].code, 0) << outcomes[0].message;
    expect_last_values(concat("floods, round ", i));
  }
}

}  // namespace
}  // namespace crowdface::testing
