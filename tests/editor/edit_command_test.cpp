// SPDX-License-Identifier: Apache-2.0
// The command itself, as a page uses it.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <Eigen/Core>  // before httplib.h, whose headers of the system clang cannot read before Eigen's
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "crowdface/core/text.h"

#include "support/program.h"
#include "support/small_crowd.h"

namespace crowdface::testing {
namespace {

using Json = nlohmann::ordered_json;

SmallCrowd some_crowd() {
  SmallCrowd crowd;
  crowd.regions = 2;
  crowd.levels = "basis";
  return crowd;
}

class EditCommandTest : public ::testing::Test {
 protected:
  EditCommandTest() : folder_(some_crowd()) {}

  /// Runs the editor for as long as `use` takes, then sends it the signal. \return its exit code.
  int edit(const std::function<void()>& use, int signal = SIGTERM) {
    const Outcome outcome = run_program(CROWDFACE_PROGRAM, arguments(), [&](pid_t process) {
      wait_for_address();
      use();
      ::kill(process, signal);
    });
    outcome_ = outcome;
    return outcome.code;
  }
  std::vector<std::string> arguments() const {
    std::vector<std::string> all = {"edit",         folder_.config().string(),
                                    "--cache",      folder_.cache().string(),
                                    "--no-browser", "--quiet"};
    all.insert(all.end(), more_.begin(), more_.end());
    return all;
  }
  std::filesystem::path edits() const {
    return folder_.config().parent_path() / "config_edits.yaml";
  }
  std::filesystem::path edited(const std::string& name) const {
    return folder_.out() / "edited" / name;
  }

  httplib::Result get(const std::string& what) const {
    return answered([&](httplib::Client& client) { return client.Get(path_ + what); });
  }
  httplib::Result post(const std::string& what, const Json& body) const {
    return answered([&](httplib::Client& client) {
      return client.Post(path_ + what, {{"Origin", host_}}, body.dump(), "application/json");
    });
  }
  int put(const std::string& what, const std::string& body) const {
    return answered([&](httplib::Client& client) {
             return client.Put(path_ + what, {{"Origin", host_}}, body, "application/json");
           })
        ->status;
  }
  Json start() const {
    Json recipe = Json::parse(get("api/job")->body)["start"];
    recipe["id"] = "eva";
    recipe["target"] = folder_.names()[1];
    return recipe;
  }

  SmallCrowdFolder folder_;
  std::vector<std::string> more_;  ///< arguments
  Outcome outcome_;
  std::string address_, host_, path_;

 private:
  /// A machine with much other work may be slow to answer.
  httplib::Result answered(const std::function<httplib::Result(httplib::Client&)>& ask) const {
    httplib::Client client(host_);
    client.set_read_timeout(std::chrono::seconds(60));
    httplib::Result result = ask(client);
    if (!result) throw std::runtime_error("no answer: " + httplib::to_string(result.error()));
    return result;
  }
  void wait_for_address() {
    for (int i = 0; i < 600; ++i) {
      address_ = read_text(edited(".address"));
      if (!address_.empty()) break;  // the file is there before the address stands in it
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ASSERT_THAT(address_, ::testing::StartsWith("http://127.0.0.1:"));
    host_ = address_.substr(0, address_.find('/', 7));
    path_ = address_.substr(host_.size());
  }
};

TEST_F(EditCommandTest, WhatItSavesIsWhatBlendMakes) {
  const std::vector<std::string> formats = {"obj", "ply", "glb", "npy", "usda"};
  const int code = edit([&] {
    for (const std::string& format : formats) {
      const auto saved = post("api/save", {{"recipe", start()}, {"format", format}});
      ASSERT_EQ(saved->status, 200) << saved->body;
      EXPECT_EQ(Json::parse(saved->body)["file"], edited("eva." + format).string());
    }
    EXPECT_EQ(post("api/save", {{"recipe", start()}, {"format", "stl"}})->status, 400);
  });
  EXPECT_EQ(code, 0) << outcome_.err;
  for (const std::string& format : formats) {
    const std::string blended = (folder_ / "blended").string() + "/eva." + format;
    std::filesystem::create_directories(folder_ / "blended");
    const Outcome blend = run_program(
        CROWDFACE_PROGRAM, {"blend", folder_.config(), "--cache", folder_.cache(), "--recipe",
                            edited("edited.jsonl").string() + "#eva", "-o", blended, "--quiet"});
    ASSERT_EQ(blend.code, 0) << blend.err;
    EXPECT_EQ(read_text(blended), read_text(edited("eva." + format))) << format;
  }
}

TEST_F(EditCommandTest, KilledAtAnyMomentItHasTheLastState) {
  edit([&] { EXPECT_EQ(put("api/state", R"({"history": [1, 2]})"), 200); }, SIGKILL);
  EXPECT_EQ(outcome_.code, -SIGKILL);
  std::filesystem::remove(edited(".address"));  // the killed one's
  edit([&] {
    EXPECT_EQ(get("api/state")->body, R"({"history": [1, 2]})");
    EXPECT_EQ(put("api/state", R"({"history": )"), 400);
    EXPECT_EQ(get("api/state")->body, R"({"history": [1, 2]})");
  });
}

// What was saved went through a link that had taken the folder's place.
TEST_F(EditCommandTest, WritesNothingIntoAFolderThatTookTheOthersPlace) {
  namespace fs = std::filesystem;
  fs::create_directories(folder_ / "elsewhere");
  edit([&] {
    fs::rename(edited(""), folder_ / "moved");
    fs::create_directory_symlink(folder_ / "elsewhere", folder_.out() / "edited");
    EXPECT_NE(put("api/state", "1"), 200);
    EXPECT_NE(post("api/save", {{"recipe", start()}, {"format", "obj"}})->status, 200);
    EXPECT_NE(post("api/masks/save", Json::object())->status, 200);
    EXPECT_NE(post("api/generate", Json::object())->status, 202);
    EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
    EXPECT_FALSE(fs::exists(folder_ / "moved/eva.obj"));
    fs::remove(folder_.out() / "edited");
    fs::rename(folder_ / "moved", edited("").parent_path());
    EXPECT_EQ(put("api/state", "1"), 200);
  });
}

// Only the marks of the last editor were kept.
TEST_F(EditCommandTest, KeepsTheMarksOfEditorsBeforeIt) {
  ASSERT_EQ(run_program(CROWDFACE_PROGRAM,
                        {"generate", folder_.config(), "--cache", folder_.cache(), "--quiet"})
                .code,
            0);
  const auto mark = [&](const std::string& id, const std::string& note) {
    return post("api/review",
                {{"id", id}, {"verdict", "reject"}, {"lock", {"region_1"}}, {"note", note}});
  };
  edit([&] {
    EXPECT_EQ(mark("mob_0001", "first: \"a\"\nb")->status, 200);
    EXPECT_EQ(mark("mob_0002", "second")->status, 200);
  });
  const std::string before = read_text(edited("review.yaml"));
  edit([&] {
    EXPECT_EQ(mark("mob_0002", "second, again")->status, 200);
    EXPECT_EQ(mark("mob_0003", "third")->status, 200);
    EXPECT_EQ(mark("mob_0003", "third, again")->status, 200);
  });
  const std::string after = read_text(edited("review.yaml"));
  EXPECT_THAT(after, ::testing::StartsWith(before.substr(0, before.find("  mob_0002"))));
  EXPECT_THAT(after, ::testing::HasSubstr("second, again"));
  EXPECT_THAT(after, ::testing::HasSubstr("third, again"));
  const std::string by_hand = "schema: 1\nfaces: {nobody: keep, mob_0001: keep}\n";
  std::ofstream(edited("review.yaml")) << by_hand;
  edit([&] {
    const auto refused = mark("mob_0003", "");
    EXPECT_EQ(refused->status, 400);
    EXPECT_THAT(refused->body, ::testing::HasSubstr("review.yaml:2"));
  });
  EXPECT_EQ(read_text(edited("review.yaml")), by_hand);
}

// The mesh in a format that was saved before kept the older recipe.
TEST_F(EditCommandTest, AllFormatsOfAFaceFollowItsRecipe) {
  edit([&] {
    Json recipe = start();
    ASSERT_EQ(post("api/save", {{"recipe", recipe}, {"format", "obj"}})->status, 200);
    const std::string before = read_text(edited("eva.obj"));
    recipe["target"] = folder_.names()[2];
    ASSERT_EQ(post("api/save", {{"recipe", recipe}, {"format", "ply"}})->status, 200);
    const std::string after = read_text(edited("eva.obj"));
    EXPECT_NE(after, before);
    ASSERT_EQ(post("api/save", {{"recipe", recipe}, {"format", "obj"}})->status, 200);
    EXPECT_EQ(read_text(edited("eva.obj")), after);
  });
}

TEST_F(EditCommandTest, ASecondEditorIsToldOfTheFirst) {
  edit([&] {
    struct stat status {};
    ASSERT_EQ(::stat(edited(".address").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    const Outcome second = run_program(CROWDFACE_PROGRAM, arguments());
    EXPECT_EQ(second.code, 64);
    EXPECT_THAT(second.err, ::testing::HasSubstr(address_));
  });
  EXPECT_FALSE(std::filesystem::exists(edited(".address")));
}

TEST_F(EditCommandTest, PutsARecipeIntoTheEditsOfTheConfig) {
  const std::string before = read_text(folder_.config());
  edit([&] {
    EXPECT_EQ(post("api/recipes", {{"recipe", start()}})->status, 200);
    Json wrong = start();
    wrong["id"] = "small_0001x/";
    EXPECT_EQ(post("api/recipes", {{"recipe", wrong}})->status, 400);
  });
  const std::string after = read_text(folder_.config());
  EXPECT_THAT(after, ::testing::StartsWith(before));
  EXPECT_THAT(after.substr(before.size()), ::testing::HasSubstr("edits: "));
  EXPECT_THAT(read_text(edits()), ::testing::HasSubstr("- {id: eva"));
  const Outcome check =
      run_program(CROWDFACE_PROGRAM, {"check", folder_.config(), "--cache", folder_.cache()});
  EXPECT_EQ(check.code, 0) << check.err;
}

TEST_F(EditCommandTest, OpensACrowdAndReviewsIt) {
  std::ofstream(folder_.config(), std::ios::app)
      << "recipes: [{id: adam, target: " << folder_.names()[0]
      << ", regions: {all: {smoothness: 0.2, position: [0, 0]}}}]\n";
  ASSERT_EQ(run_program(CROWDFACE_PROGRAM,
                        {"generate", folder_.config(), "--cache", folder_.cache(), "--quiet"})
                .code,
            0);
  edit([&] {
    const Json crowd = Json::parse(get("api/job")->body)["crowd"];
    ASSERT_EQ(crowd["faces"].size(), 5U);
    Json first = crowd["faces"][1];
    for (const char* fact : {"index", "attempt", "family"}) first.erase(fact);
    const auto face = post("api/face", {{"recipe", first}, {"measure", true}});
    EXPECT_EQ(face->status, 200);
    const Json measured = Json::parse(post("api/measures", {{"recipe", first}})->body);
    EXPECT_GT(measured["nearest_head"]["mm"], 0);
    EXPECT_TRUE(measured["nearest_face"].is_object());
    EXPECT_EQ(post("api/measures", {{"recipe", "none"}})->status, 400);
    EXPECT_EQ(post("api/save", {{"recipe", first}, {"format", "obj"}})->status, 200);
    const std::string id = first["id"];
    EXPECT_EQ(read_text(edited(id + ".obj")), read_text(folder_.out() / "meshes" / (id + ".obj")));
    EXPECT_EQ(post("api/review",
                   {{"id", id}, {"verdict", "reject"}, {"lock", {"region_1"}}, {"note", "a \"b\""}})
                  ->status,
              200);
    EXPECT_EQ(post("api/review", {{"id", "nobody"}, {"verdict", "keep"}})->status, 400);
    const auto by_hand = post("api/review", {{"id", "adam"}, {"verdict", "reject"}});
    EXPECT_EQ(by_hand->status, 400);
    EXPECT_THAT(by_hand->body, ::testing::HasSubstr("written by hand"));
    EXPECT_EQ(post("api/review", {{"id", "adam"}, {"verdict", "keep"}})->status, 200);
    const auto change = [&](const std::string& id_to_change, const Json& what) {
      return post("api/review", {{"id", id_to_change}, {"change", what}});
    };
    EXPECT_EQ(change("mob_0002", {{"variant_of", "mob_0003"}})->status, 200);
    EXPECT_EQ(change("mob_0003", {{"colours", {{folder_.names()[0], 1}}}})->status, 200);
    EXPECT_EQ(change("mob_0004", {{"variant_of", "mob_0003"}})->status, 200);
    EXPECT_EQ(change("mob_0004", Json::object())->status, 200);
    const auto refused = change("mob_0003", {{"ages", 1}});
    EXPECT_EQ(refused->status, 400);
    EXPECT_THAT(refused->body, ::testing::HasSubstr("ages"));
    // A mark leaves the changes, which were lost.
    EXPECT_EQ(post("api/review", {{"id", "mob_0004"}, {"verdict", "keep"}})->status, 200);
  });
  const std::string review = read_text(edited("review.yaml"));
  EXPECT_THAT(review, ::testing::HasSubstr("after: 0\n"));
  EXPECT_THAT(review, ::testing::HasSubstr("mob_0002: {variant_of: mob_0003"));
  EXPECT_THAT(review, ::testing::HasSubstr(concat("mob_0003: {colours: {", folder_.names()[0])));
  EXPECT_THAT(review, ::testing::Not(::testing::HasSubstr("mob_0004: {variant_of")));
  const Outcome plan = run_program(
      CROWDFACE_PROGRAM, {"plan", folder_.config(), "--cache", folder_.cache(), "--review",
                          edited("review.yaml"), "--out", folder_ / "again"});
  EXPECT_EQ(plan.code, 0) << plan.err;

  // The crowd has this review now: further marks begin another one, so that nothing applies twice.
  ASSERT_EQ(
      run_program(CROWDFACE_PROGRAM, {"generate", folder_.config(), "--cache", folder_.cache(),
                                      "--quiet", "--review", edited("review.yaml")})
          .code,
      0);
  edit([&] {
    EXPECT_EQ(post("api/review", {{"id", "mob_0004"}, {"verdict", "keep"}})->status, 200);
  });
  EXPECT_EQ(read_text(edited("review.yaml")),
            "schema: 1\nafter: 1\nfaces:\n  mob_0004: {mark: keep}\n");
}

// The run beside the page did not know of the editor's --limit, and refused what the editor had opened.
TEST_F(EditCommandTest, GeneratesTheCrowdBesideThePageUnderTheSameLimits) {
  std::ofstream(folder_.config(), std::ios::app) << '#' << std::string(1 << 20, 'x') << '\n';
  more_ = {"--limit", "yaml_bytes=2000000"};
  const auto state = [&] { return Json::parse(get("api/generate")->body)["state"]; };
  edit([&] {
    EXPECT_EQ(state(), "idle");
    EXPECT_EQ(post("api/generate", Json::object())->status, 202);
    for (int i = 0; i < 600 && state() == "running"; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    EXPECT_EQ(state(), "done") << read_text(edited("generate.log"));
  });
  const Outcome verify = run_program(CROWDFACE_PROGRAM, {"verify", folder_.out()});
  EXPECT_EQ(verify.code, 0) << verify.err;
}

TEST_F(EditCommandTest, OpensTheFacesThatWereGenerated) {
  const auto job = [&] { return Json::parse(get("api/job")->body); };
  edit([&] {
    EXPECT_TRUE(job()["crowd"].is_null());
    ASSERT_EQ(run_program(CROWDFACE_PROGRAM,
                          {"generate", folder_.config(), "--cache", folder_.cache(), "--quiet"})
                  .code,
              0);
    EXPECT_EQ(post("api/open", Json::object())->status, 200);
    EXPECT_EQ(job()["crowd"]["faces"].size(), 4U);
  });
}

TEST_F(EditCommandTest, RegionsComeAndGoInTheConfig) {
  const auto names = [&] {
    std::vector<std::string> found;
    const Json job = Json::parse(get("api/job")->body);
    for (const Json& region : job["regions"]) found.push_back(region["name"]);
    return found;
  };
  const auto error = [](const httplib::Result& answer) {
    EXPECT_EQ(answer->status, 400);
    return Json::parse(answer->body)["error"].get<std::string>();
  };
  edit([&] {
    EXPECT_EQ(post("api/regions", {{"add", "cheek"}})->status, 200);
    EXPECT_THAT(names(), ::testing::ElementsAre("region_1", "region_2", "cheek"));
    const std::string saved = read_text(edits());
    EXPECT_THAT(saved, ::testing::HasSubstr("names: [region_1, region_2, cheek]"));
    EXPECT_THAT(saved, ::testing::HasSubstr("edited/masks.png"));
    EXPECT_EQ(post("api/save", {{"recipe", start()}, {"format", "ply"}})->status, 200);

    EXPECT_THAT(error(post("api/regions", {{"add", "a: b"}})), ::testing::HasSubstr("a: b"));
    EXPECT_THAT(error(post("api/regions", {{"add", "cheek"}})), ::testing::HasSubstr("twice"));
    EXPECT_THAT(error(post("api/regions", {{"remove", "chin"}})), ::testing::HasSubstr("remove"));
    EXPECT_EQ(read_text(edits()), saved);

    EXPECT_EQ(post("api/regions", {{"remove", "region_2"}})->status, 200);
    EXPECT_THAT(names(), ::testing::ElementsAre("region_1", "cheek"));
    EXPECT_THAT(read_text(edits()), ::testing::HasSubstr("edited/masks-"))
        << "the first masks stay for undo";
    EXPECT_EQ(post("api/face", {{"recipe", start()}})->status, 200);

    // Each change of the regions can be taken back: to those before the last, and to the config's own.
    const std::string cheeks = saved.substr(saved.find('{'), saved.find('}') - saved.find('{') + 1);
    const auto back = post("api/regions", {{"back", cheeks}});
    EXPECT_EQ(back->status, 200) << back->body;
    EXPECT_EQ(Json::parse(back->body)["regions"], cheeks);
    EXPECT_EQ(read_text(edits()), saved);
    EXPECT_THAT(names(), ::testing::ElementsAre("region_1", "region_2", "cheek"));
    EXPECT_THAT(error(post("api/regions", {{"back", "{names: [a]}\nrecipes: []"}})),
                ::testing::HasSubstr("regions"));
    EXPECT_EQ(post("api/regions", {{"back", nullptr}})->status, 200);
    EXPECT_THAT(names(), ::testing::ElementsAre("region_1", "region_2"));
    EXPECT_EQ(Json::parse(get("api/job")->body)["regions_edit"], nullptr);
  });
  const Outcome check =
      run_program(CROWDFACE_PROGRAM, {"check", folder_.config(), "--cache", folder_.cache()});
  EXPECT_EQ(check.code, 0) << check.err;
}

TEST_F(EditCommandTest, DroppedHeadsJoinTheConfigIfItCanUseThem) {
  const std::string config = read_text(folder_.config());
  const std::string head = read_text(folder_.head(folder_.names()[0]));
  const auto error = [](const httplib::Result& answer) {
    EXPECT_EQ(answer->status, 400) << answer->body;
    return Json::parse(answer->body)["error"].get<std::string>();
  };
  const auto heads = [&] {
    std::vector<std::string> names;
    const Json job = Json::parse(get("api/job")->body);
    for (const Json& one : job["heads"]) names.push_back(one["name"]);
    return names;
  };
  const auto drop = [&](const std::string& name, const std::string& text) {
    EXPECT_EQ(post("api/dropped", {{name, text.size()}})->status, 200);
    const std::size_t half = text.size() / 2;
    EXPECT_EQ(put("api/dropped/0/" + name, text.substr(0, half)), 200);
    EXPECT_EQ(put("api/dropped/" + std::to_string(half) + "/" + name, text.substr(half)), 200);
    return post("api/heads", Json::object());
  };
  const std::filesystem::path added = folder_.config().parent_path() / "added";
  edit([&] {
    for (const char* name : {"../eva.obj", "a/eva.obj", ".eva.obj", "eva\n.obj", "", "eva.exe"}) {
      EXPECT_FALSE(error(post("api/dropped", {{name, 3}})).empty()) << name;
    }
    EXPECT_THAT(error(post("api/dropped", {{"skin.png", 3}})), ::testing::HasSubstr("heads"));
    EXPECT_THAT(error(post("api/dropped", {{"eva.obj", 3e9}})), ::testing::HasSubstr("2 GiB"));
    EXPECT_EQ(put("api/dropped/0/eva.obj", "v 0 0 0"), 400) << "it was not announced";
    EXPECT_EQ(put("api/dropped/x/eva.obj", "v 0 0 0"), 404);
    EXPECT_EQ(post("api/dropped", {{"eva.obj", 3}})->status, 200);
    EXPECT_EQ(put("api/dropped/0/eva.obj", "v 0 0 0"), 400) << "it is larger than announced";
    EXPECT_EQ(put("api/dropped/1/eva.obj", "v"), 400) << "a piece is missing";
    EXPECT_THAT(error(post("api/heads", Json::object())), ::testing::HasSubstr("incomplete"));

    EXPECT_THAT(error(drop("eva.obj", "v 0 0 0\nf 1 2 3\n")), ::testing::HasSubstr("eva.obj"));
    EXPECT_THAT(error(drop(folder_.names()[1] + ".obj", head)),
                ::testing::HasSubstr("two heads are called"));
    EXPECT_EQ(read_text(folder_.config()), config);
    EXPECT_FALSE(std::filesystem::exists(added));
    EXPECT_EQ(heads(), folder_.names());

    const auto joined = drop("eva.obj", head);
    ASSERT_EQ(joined->status, 200) << joined->body;
    std::vector<std::string> more = folder_.names();
    more.emplace_back("eva");
    EXPECT_EQ(heads(), more);
    EXPECT_EQ(read_text(added / "eva" / "eva.obj"), head);
    const std::string faces = Json::parse(joined->body)["faces"];
    EXPECT_EQ(Json::parse(get("api/job")->body)["faces_edit"], faces);
    EXPECT_THAT(read_text(edits()), ::testing::HasSubstr("also: [added/eva/eva.obj]"));

    // Heads that were added can be taken away and added again, and others with them.
    EXPECT_EQ(post("api/heads", {{"back", nullptr}})->status, 200);
    EXPECT_EQ(heads(), folder_.names());
    EXPECT_EQ(post("api/heads", {{"back", faces}})->status, 200);
    EXPECT_EQ(drop("zoe.obj", head)->status, 200);
    more.emplace_back("zoe");
    EXPECT_EQ(heads(), more);
    EXPECT_THAT(error(drop("eva.obj", head)), ::testing::HasSubstr("two heads are called"));
    EXPECT_EQ(heads(), more);
  });
  const Outcome check =
      run_program(CROWDFACE_PROGRAM, {"check", folder_.config(), "--cache", folder_.cache()});
  EXPECT_EQ(check.code, 0) << check.err;
}

TEST_F(EditCommandTest, BenchmarksWithoutServing) {
  std::vector<std::string> benchmark = arguments();
  benchmark.emplace_back("--benchmark");
  const Outcome outcome = run_program(CROWDFACE_PROGRAM, benchmark);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, ::testing::HasSubstr("one region was moved"));
  EXPECT_FALSE(std::filesystem::exists(folder_.out()));
}

TEST_F(EditCommandTest, AnswersWhatIsWrongWithASentence) {
  edit([&] {
    for (const char* body :
         {"", "[]", "{}", R"({"recipe": 3})", R"({"recipe": {"id": "a/b", "regions": {}}})",
          R"({"recipe": {"id": "a"}, "turn": "x", "page": "p"})"}) {
      const auto answer = httplib::Client(host_).Post(path_ + "api/face", {{"Origin", host_}}, body,
                                                      "application/json");
      EXPECT_EQ(answer->status, 400) << body;
      EXPECT_FALSE(Json::parse(answer->body)["error"].get<std::string>().empty()) << body;
    }
    EXPECT_EQ(get("api/heads/4")->status, 404);
    EXPECT_EQ(get("api/heads/0/thumbnail")->get_header_value("Content-Type"), "image/png");
    EXPECT_EQ(get("../config.yaml")->status, 404);
  });
}

}  // namespace
}  // namespace crowdface::testing
