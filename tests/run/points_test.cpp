// SPDX-License-Identifier: Apache-2.0
// Points that follow the faces of a crowd.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/mesh_files.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

class PointsOfACrowd : public ::testing::Test {
 protected:
  PointsOfACrowd() : folder_(crowd()) {
    folder_.folder().write("rig.yaml",
                           "template: heads/ann.obj\n"
                           "points:\n  jaw: [0.5, -1, 0.25]\n  ear_L: [2, 0, 0]\n");
  }
  static SmallCrowd crowd() {
    SmallCrowd crowd;
    crowd.count = 2;
    crowd.levels = "basis";
    crowd.more =
        "\npoints: rig.yaml\nrecipes: [{id: herself, target: ann, regions: {all: "
        "{iterations: 0, extrapolation: 1}}}]";
    return crowd;
  }
  void run(const std::string& meshes, Replace replace = Replace::kRefuse) {
    testing::run(folder_, {"output.meshes=" + meshes}, replace);
  }
  void expect_refused(const std::string& text, const std::string& told) {
    folder_.folder().write("rig.yaml", text);
    testing::expect_error(ExitCode::kUsage, {"rig.yaml", told}, [&] { run("[glb]"); });
  }
  fs::path mesh(const std::string& name) const { return folder_.out() / "meshes" / name; }

  SmallCrowdFolder folder_;
};

TEST_F(PointsOfACrowd, AreTheSameInEveryFile) {
  run("[glb, usd]");
  for (const auto& line : testing::plan_lines(folder_.out())) {
    const std::string id = line.at("id");
    const auto points = testing::read_json(mesh(id + "+points.json")).at("points");
    ASSERT_EQ(points.size(), 2U);
    const auto nodes = testing::read_glb(mesh(id + ".glb")).scene.at("nodes");
    EXPECT_THAT(nodes.at(0).at("children"), ElementsAre(1, 2));
    EXPECT_EQ(nodes.at(1).at("name"), "jaw");
    EXPECT_EQ(nodes.at(2).at("name"), "ear_L");
    const std::string usd = testing::read_text(mesh(id + ".usda"));
    for (std::size_t n = 1; n <= 2; ++n) {
      const auto& point = points.at(nodes.at(n).at("name").get<std::string>());
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(nodes.at(n).at("translation").at(c).get<float>(), point.at(c).get<float>());
      }
    }
    EXPECT_THAT(usd, HasSubstr("def Xform \"ear_L\""));
  }
  const auto own = testing::read_json(mesh("herself+points.json")).at("points").at("jaw");
  EXPECT_NEAR(own.at(0), 0.5, 1e-5);
  EXPECT_NEAR(own.at(1), -1, 1e-5);
  EXPECT_NEAR(own.at(2), 0.25, 1e-5);
}

TEST_F(PointsOfACrowd, MayBeEachHeadsOwn) {
  std::string text = "heads:\n";
  for (const std::string& name : folder_.names()) text += "  " + name + ": {jaw: [1, 2, 3]}\n";
  folder_.folder().write("rig.yaml", text);
  run("[obj]");
  const auto own = testing::read_json(mesh("herself+points.json")).at("points").at("jaw");
  EXPECT_NEAR(own.at(0), 1, 1e-5);
  EXPECT_NEAR(own.at(2), 3, 1e-5);
}

TEST_F(PointsOfACrowd, AreRecordedVerifiedResumedAndRemoved) {
  run("[obj]");
  const auto whole = testing::crowd_files(folder_.out());
  fs::remove(mesh("herself+points.json"));
  EXPECT_THAT(verify_crowd(folder_.out()).missing_files, ElementsAre("meshes/herself+points.json"));
  run("[obj]");
  EXPECT_THAT(testing::differing_files(whole, testing::crowd_files(folder_.out())), IsEmpty());
  EXPECT_EQ(testing::read_json(folder_.out() / "timings.json").at("faces"), 1);
  folder_.folder().write("rig.yaml", "template: heads/ann.obj\npoints: {jaw: [0, -1, 0]}\n");
  run("[obj]");
  EXPECT_EQ(testing::read_json(folder_.out() / "timings.json").at("faces"), 3) << "other points";
  run("[]", Replace::kForce);
  EXPECT_FALSE(fs::exists(mesh("herself+points.json")));
}

TEST_F(PointsOfACrowd, AreRefusedByTheirLine) {
  expect_refused("template: heads/ann.obj\npoints:\n  jaw: [0, 1]\n", ":3:");
  expect_refused("template: heads/ann.obj\npoints:\n  jaw: [0, 1, x]\n", "[x, y, z]");
  // No face could be written with it, which came out when the first was made.
  expect_refused("template: heads/ann.obj\npoints:\n  jaw: [0, 1, 1e300]\n", "numbers up to 1e+07");
  expect_refused("points: {jaw: [0, 1, 2]}\n", "template is missing");
  expect_refused("joints: {jaw: [0, 1, 2]}\n", "unknown key \"joints\"");
  expect_refused("heads: {ann: {jaw: [0, 1, 2]}}\n", "\"bob\" is missing");
  expect_refused("template: heads/ann.obj\npoints: {}\n", "1 to 1000 points");
}

}  // namespace
}  // namespace crowdface
