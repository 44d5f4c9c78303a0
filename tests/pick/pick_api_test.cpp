// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/pick_api.h"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/vector3.h"

#include "pick/some_template.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

using Json = nlohmann::ordered_json;

/// A template, and a scan of another head, in centimetres both.
class PickApiTest : public ::testing::Test {
 protected:
  PickInputs inputs() const {
    const Positions cm = some_head(0);
    return {shape_,       10 * cm, cm,      {some_head(1), triangles_of(shape_.topology)},
            std::nullopt, "t.obj", "s.obj", file_};
  }
  HttpAnswer ask(const std::string& method, const std::string& path, const Json& body = {}) {
    return api_.answer({method, path, body.is_null() ? std::string() : body.dump()});
  }
  Json json(const std::string& method, const std::string& path, const Json& body = {}) {
    const HttpAnswer answer = ask(method, path, body);
    EXPECT_EQ(answer.status, 200) << answer.bytes;
    return Json::parse(answer.bytes);
  }
  void expect_refused(const std::string& method, const std::string& path, const Json& body,
                      const std::string& phrase) {
    const HttpAnswer answer = ask(method, path, body);
    EXPECT_EQ(answer.status, 400) << body.dump();
    EXPECT_THAT(answer.bytes, ::testing::HasSubstr(phrase));
  }
  /// A look at a vertex from in front.
  static Json look(const std::string& mesh, const Eigen::Vector3d& at) {
    return {{"mesh", mesh}, {"origin", {at.x(), at.y(), at.z() + 1000}}, {"direction", {0, 0, -3}}};
  }
  std::uint32_t foremost() const {
    Index v = 0;
    Positions skin = shape_.skin.rows_of(shape_.positions);
    skin.col(2).maxCoeff(&v);
    return shape_.skin.vertices[static_cast<std::size_t>(v)];
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "landmarks.yaml";
  WrapTemplate shape_ = some_template();
  PickableScans scans_{{{"s.obj", file_}},
                       [this](const PickableScans::Entry&) { return inputs(); }};
  PickSession& session_ = scans_.current()->session;
  PickApi api_{scans_, std::nullopt, 2000};
};

TEST_F(PickApiTest, WhatIsPickedAndSavedIsReadBackByTheWrap) {
  const std::uint32_t tip = foremost();
  const Json on_template =
      json("POST", "api/pick", look("template", row3(shape_.positions, tip)))["place"];
  EXPECT_EQ(on_template["vertex"], tip);
  const Json on_scan =
      json("POST", "api/pick", look("scan", row3(session_.inputs().scan.positions, tip)))["place"];
  EXPECT_FALSE(on_scan.contains("vertex"));
  const Json landmarks = {
      {{"name", "nose_tip"}, {"template", on_template["vertex"]}, {"scan", on_scan["point"]}},
      {{"name", "a: b"}, {"template", 3}, {"scan", nullptr}},
      {{"name", "corner"}, {"template", 5}, {"scan", 12}}};
  EXPECT_EQ(json("PUT", "api/landmarks", {{"landmarks", landmarks}})["pairs"], 2);

  const LandmarkFile saved = read_landmarks(file_);
  EXPECT_TRUE(saved.template_places.contains("a: b"));
  const auto matched =
      match_landmarks(saved, session_.inputs().template_file_positions, session_.inputs().scan);
  ASSERT_EQ(matched.size(), 2U);
  EXPECT_EQ(matched[0].name, "corner");
  EXPECT_EQ(matched[0].scan_position, row3(session_.inputs().scan.positions, 12));
  EXPECT_EQ(matched[1].vertex, tip);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(matched[1].scan_position[c],
              on_scan["point"][static_cast<std::size_t>(c)].get<double>());
    EXPECT_NEAR(matched[1].scan_position[c], session_.inputs().scan.positions(tip, c), 2e-4);
  }

  // A page that is opened later gets them, and gives the same file.
  PickableScans later({{"s.obj", file_}}, [this](const PickableScans::Entry&) { return inputs(); });
  const Json job = Json::parse(PickApi(later, {}, 100).answer({"GET", "api/job", ""}).bytes);
  EXPECT_EQ(job["landmarks"].size(), 3U);
  EXPECT_EQ(job["landmarks"][0]["name"], "nose_tip");
  EXPECT_EQ(job["landmarks"][0]["scan"]["point"], on_scan["point"]);
  const std::string before = read_file(file_);
  later.current()->session.save(later.current()->session.landmarks());
  EXPECT_EQ(read_landmarks(file_).template_places.size(), 3U);
  EXPECT_EQ(read_file(file_).size(), before.size());
}

TEST_F(PickApiTest, TheNextScanOfAFolderTakesOverWhatWasPickedOnTheTemplate) {
  const std::filesystem::path first = folder_ / "a.yaml", second = folder_ / "b.yaml";
  const auto read_inputs = [&](const PickableScans::Entry& entry) {
    PickInputs of_one = inputs();
    of_one.scan_file = entry.scan_file;
    of_one.landmark_file = entry.landmark_file;
    return of_one;
  };
  PickableScans scans({{"a.obj", first}, {"b.obj", second}}, read_inputs);
  PickApi api(scans, std::nullopt, 100);
  const Json landmarks = {{{"name", "chin"}, {"template", 5}, {"scan", 12}}};
  EXPECT_EQ(api.answer({"PUT", "api/landmarks", Json{{"landmarks", landmarks}}.dump()}).status,
            200);
  EXPECT_EQ(api.answer({"POST", "api/open", R"({"scan": 2})"}).status, 400);
  ASSERT_EQ(api.answer({"POST", "api/open", R"({"scan": 1})"}).status, 200);
  const Json job = Json::parse(api.answer({"GET", "api/job", ""}).bytes);
  EXPECT_EQ(job["number"], 1);
  EXPECT_EQ(job["scan"]["name"], "b.obj");
  EXPECT_EQ(job["scans"][0]["picked"], true);
  EXPECT_EQ(job["scans"][1]["picked"], false);
  ASSERT_EQ(job["landmarks"].size(), 1U);
  EXPECT_EQ(job["landmarks"][0]["template"]["vertex"], 5);
  EXPECT_TRUE(job["landmarks"][0]["scan"].is_null());
  EXPECT_FALSE(std::filesystem::exists(second));
  // Opened again, it begins with the first that is not done.
  EXPECT_EQ(PickableScans(scans.entries(), read_inputs).current_index(), 1U);
}

TEST_F(PickApiTest, FewerTrianglesAreShownThanArePicked) {
  const HttpAnswer mesh = ask("GET", "api/mesh/scan");
  std::uint32_t length = 0;
  std::memcpy(&length, mesh.bytes.data(), sizeof(length));
  const Json head = Json::parse(mesh.bytes.substr(4, length));
  EXPECT_EQ(head["whole_triangles"], session_.inputs().scan.triangles.size());
  for (const Json& array : head["arrays"]) {
    if (array["name"] == "triangles") {
      EXPECT_LE(array["count"].get<std::size_t>(), 3 * 2000U);
      EXPECT_GT(array["count"].get<std::size_t>(), 3 * 1000U);
    }
  }
}

TEST_F(PickApiTest, BesideTheMeshThereIsNothing) {
  EXPECT_TRUE(json("POST", "api/pick", look("scan", {500, 0, 0}))["place"].is_null());
  EXPECT_TRUE(json("POST", "api/pick", look("template", {5000, 0, 0}))["place"].is_null());
}

TEST_F(PickApiTest, OnAnEyeNothingIsPickedButAtItsRim) {
  for (const Part& part : shape_.parts.parts) {
    if (!part.is_eyeball) continue;
    const Eigen::Vector3d centre = shape_.parts.shapes[part.ball_component].centre;
    EXPECT_TRUE(json("POST", "api/pick", look("template", centre))["place"].is_null());
  }
}

TEST_F(PickApiTest, RefusesWhatAPageWouldNotAsk) {
  expect_refused("POST", "api/pick", {{"mesh", "sky"}}, "template or scan");
  expect_refused("POST", "api/pick", {{"mesh", "scan"}, {"origin", {1, 2}}}, "origin");
  expect_refused("POST", "api/pick",
                 {{"mesh", "scan"}, {"origin", {1, 2, 3}}, {"direction", {0, 0, 0}}}, "direction");
  const auto put = [&](const Json& landmark, const std::string& phrase) {
    expect_refused("PUT", "api/landmarks", {{"landmarks", Json::array({landmark})}}, phrase);
  };
  put({{"name", ""}}, "1 to 64");
  put({{"name", "a\nb"}}, "control characters");
  put({{"name", "a"}, {"template", 99999999}}, "from 0 to");
  put({{"name", "a"}, {"template", -1}}, "from 0 to");
  put({{"name", "a"}, {"scan", {1, 2, "3"}}}, "three numbers");
  put({{"name", "a"}, {"scan", {1, 2, 1e300}}}, "three numbers");
  put(3, "mappings");
  expect_refused("PUT", "api/landmarks", {{"landmarks", {{{"name", "a"}}, {{"name", "a"}}}}},
                 "twice");
  expect_refused("PUT", "api/landmarks", {{"landmarks", Json(std::vector<int>(101, 1))}},
                 "at most 100");
  EXPECT_EQ(ask("GET", "api/other").status, 404);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(PickApiTest, AFileThatAnotherProgramChangedIsWrittenOverOnlyWhenAskedAgain) {
  session_.save({{"chin", 1, std::nullopt, std::nullopt}});
  folder_.write("landmarks.yaml", "# by another\ntemplate: {chin: 2}\n");
  expect_error(ExitCode::kUsage, {"landmarks.yaml", "another program"}, [&] {
    session_.save({{"chin", 3, std::nullopt, std::nullopt}});
  });
  EXPECT_EQ(read_landmarks(file_).template_places.at("chin").vertex, 2U);
  session_.save({{"chin", 3, std::nullopt, std::nullopt}});
  EXPECT_EQ(read_landmarks(file_).template_places.at("chin").vertex, 3U);
  EXPECT_EQ(read_file(file_).substr(0, 13), "# by another\n");
}

TEST_F(PickApiTest, AFileThatNoWrapWouldTakeIsRefused) {
  folder_.write("landmarks.yaml", "template:\n  chin: 99999999\n");
  expect_error(ExitCode::kUsage, {"landmarks.yaml:2", "vertex of the template"},
               [&] { const PickSession session(inputs()); });
}

}  // namespace
}  // namespace crowdface::testing
