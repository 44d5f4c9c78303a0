// SPDX-License-Identifier: Apache-2.0
// Levels of detail of a crowd's faces.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/io/obj_file.h"
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

class LevelsOfACrowd : public ::testing::Test {
 protected:
  LevelsOfACrowd() : folder_(crowd()) {
    folder_.folder().write("shapes/smile.obj", testing::bowl_text(folder_.crowd().bowl, 40));
  }
  static SmallCrowd crowd() {
    SmallCrowd crowd;
    crowd.count = 2;
    crowd.levels = "basis";
    crowd.bowl.materials = true;
    crowd.bowl.normals = true;
    crowd.more = "\nshapes: {neutral: heads/ann.obj, directory: shapes}";
    return crowd;
  }
  void run(const std::string& meshes, Replace replace = Replace::kRefuse) {
    testing::run(folder_, {"output.meshes=" + meshes, "output.lods=[60 %, 25 %]"}, replace);
  }
  static std::string normal_lines(const fs::path& file) {
    const std::string text = testing::read_text(file);
    const std::size_t begin = text.find("\nvn ");
    EXPECT_NE(begin, std::string::npos) << file;
    return text.substr(begin, text.find("\nf ") - begin);
  }
  fs::path mesh(const std::string& name) const { return folder_.out() / "meshes" / name; }

  SmallCrowdFolder folder_;
};

TEST_F(LevelsOfACrowd, HoldTheFacesOwnVerticesInEveryFormat) {
  run("[obj, ply, glb, points]");
  const std::string id = testing::plan_lines(folder_.out()).front().at("id");
  const auto whole = testing::read_glb(mesh(id + ".glb"));
  const auto smile = reference::read_obj(mesh(id + "+smile.obj")).vertices;
  std::size_t before = whole.corners.size();
  for (const char* level : {"LOD1", "LOD2"}) {
    const std::string stem = concat(id, "+", level);
    const auto glb = testing::read_glb(mesh(stem + ".glb"));
    EXPECT_EQ(glb.scene.at("nodes").at(0).at("name"), concat(id, "_", level));
    EXPECT_LT(glb.corners.size(), before);
    before = glb.corners.size();
    for (std::size_t i = 0; i < glb.points.size(); ++i) {
      const auto vertex = static_cast<std::size_t>(glb.ids[i]);
      EXPECT_EQ(glb.points[i], whole.points.at(vertex));
      EXPECT_EQ(glb.normals[i], whole.normals.at(vertex));
    }
    EXPECT_THAT(glb.scene.at("meshes").at(0).at("extras").at("targetNames"), ElementsAre("smile"));
    EXPECT_EQ(glb.scene.at("materials").size(), whole.scene.at("materials").size());

    const auto ply = testing::read_ply(mesh(stem + ".ply"));
    EXPECT_EQ(3 * ply.faces.size(), glb.corners.size());
    EXPECT_EQ(ply.normals.size(), ply.points.size());
    const ObjFile obj = read_obj(mesh(stem + ".obj"));
    EXPECT_EQ(obj.topology.face_count(), static_cast<Index>(ply.faces.size()));
    EXPECT_EQ(polygon_materials(obj.materials, obj.topology.face_count()).names.size(),
              whole.scene.at("materials").size());
    EXPECT_THAT(testing::read_text(mesh(stem + ".obj")), HasSubstr(concat("\no ", id, "_", level)));
    const ObjFile smiling = read_obj(mesh(stem + "+smile.obj"));
    EXPECT_NE(normal_lines(mesh(stem + "+smile.obj")), normal_lines(mesh(stem + ".obj")));
    for (std::size_t i = 0; i < ply.points.size(); ++i) {
      EXPECT_EQ(ply.points[i], glb.points[i]);
      const auto vertex = static_cast<std::size_t>(glb.ids[i]);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto row = static_cast<Index>(i), column = static_cast<Index>(c);
        EXPECT_EQ(static_cast<float>(obj.positions(row, column)), ply.points[i][c]);
        EXPECT_EQ(smiling.positions(row, column), smile[vertex][c]);
      }
    }
  }
  EXPECT_FALSE(fs::exists(mesh(id + "+LOD1.npy")));
}

TEST(LevelsOfHeads, NameTheMaterialsOfTheirOwnTarget) {
  SmallCrowd crowd;
  crowd.bowl.materials = true;
  const SmallCrowdFolder folder(crowd);
  for (const std::string& name : folder.names()) {
    std::string text = testing::read_text(folder.head(name));
    const std::size_t at = text.find("usemtl skin");
    folder.folder().write(concat("heads/", name, ".obj"),
                          text.replace(at, 11, concat("usemtl ", name)));
  }
  run(folder, {"output.meshes=[obj]", "output.lods=[60 %]"});
  std::set<std::string> targets;
  for (const auto& line : testing::plan_lines(folder.out())) {
    const std::string id = line.at("id"), target = line.at("target");
    const ObjFile level = read_obj(folder.out() / "meshes" / (id + "+LOD1.obj"));
    ASSERT_FALSE(level.materials.empty());
    EXPECT_EQ(level.materials.front().name, target);
    targets.insert(target);
  }
  EXPECT_GT(targets.size(), 1U);
}

// Rows of an empty matrix were read.
TEST(LevelsWithoutNormals, AreWrittenAsPly) {
  SmallCrowd crowd;
  crowd.count = 1;
  const SmallCrowdFolder folder(crowd);
  run(folder, {"output.meshes=[ply]", "output.lods=[60 %]"});
  const std::string id = testing::plan_lines(folder.out()).front().at("id");
  const auto ply = testing::read_ply(folder.out() / "meshes" / (id + "+LOD1.ply"));
  EXPECT_FALSE(ply.faces.empty());
  EXPECT_THAT(ply.normals, IsEmpty());
}

TEST(SubdivisionOfUsd, IsPartOfWhatIsDone) {
  SmallCrowd crowd;
  crowd.count = 1;
  const SmallCrowdFolder folder(crowd);
  for (const char* scheme : {"none", "catmull_clark"}) {
    run(folder, {"output.meshes=[usd]", concat("output.subdivision=", scheme)}, Replace::kForce);
    EXPECT_EQ(testing::read_json(folder.out() / "timings.json").at("faces"), 1) << scheme;
  }
}

TEST_F(LevelsOfACrowd, TellTheirErrorInTheReport) {
  run("[ply]");
  const auto report = testing::read_json(folder_.out() / "report.json");
  ASSERT_EQ(report.at("lods").size(), 2U);
  const auto& [first, second] = std::pair(report.at("lods").at(0), report.at("lods").at(1));
  EXPECT_EQ(first.at("share"), 0.6);
  EXPECT_GT(first.at("triangles"), second.at("triangles"));
  EXPECT_GT(first.at("error_mm").at("max").get<double>(), 0);
  EXPECT_LT(first.at("error_mm").at("rms"), second.at("error_mm").at("rms"));
  EXPECT_GT(second.at("error_in_shapes_mm").at("max").get<double>(), 0);
  for (const auto& face : report.at("faces")) {
    EXPECT_TRUE(face.at("lods").contains("LOD1.ply"));
    EXPECT_TRUE(face.at("lods").contains("LOD2.ply"));
  }
}

TEST_F(LevelsOfACrowd, AreRecordedVerifiedResumedAndRemoved) {
  run("[obj, glb]");
  const auto whole = testing::crowd_files(folder_.out());
  const std::string id = testing::plan_lines(folder_.out()).back().at("id");
  fs::remove(mesh(id + "+LOD2+smile.obj"));
  EXPECT_THAT(verify_crowd(folder_.out()).missing_files,
              ElementsAre("meshes/" + id + "+LOD2+smile.obj"));
  run("[obj, glb]");
  EXPECT_THAT(testing::differing_files(whole, testing::crowd_files(folder_.out())), IsEmpty());
  EXPECT_EQ(testing::read_json(folder_.out() / "timings.json").at("faces"), 1);
  run("[points]", Replace::kForce);
  EXPECT_FALSE(fs::exists(mesh(id + "+LOD1.glb")));
  EXPECT_FALSE(fs::exists(mesh(id + "+LOD2+smile.obj")));
}

TEST_F(LevelsOfACrowd, RefuseAShapeOfTheirName) {
  folder_.folder().write("shapes/LOD1.obj", testing::bowl_text(folder_.crowd().bowl, 40));
  testing::expect_error(ExitCode::kUsage, {"output.lods", "LOD1"}, [&] { run("[obj]"); });
}

}  // namespace
}  // namespace crowdface
