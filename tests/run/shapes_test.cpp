// SPDX-License-Identifier: Apache-2.0
// Expressions of a template, carried to the faces of a crowd and written beside them.
#include <set>

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

constexpr const char* kShapes = "\nshapes: {neutral: heads/ann.obj, directory: shapes}";

/// A crowd whose template is its first head; "other" is another person's face as an expression, and
/// "still" moves nothing and is left out.
class ShapesOfACrowd : public ::testing::Test {
 protected:
  ShapesOfACrowd() : folder_(crowd(kShapes)) {
    folder_.folder().write("shapes/other.obj", testing::bowl_text(folder_.crowd().bowl, 40));
    folder_.folder().write("shapes/still.obj", testing::read_text(folder_.head("ann")));
  }
  static SmallCrowd crowd(const char* shapes) {
    SmallCrowd crowd;
    crowd.count = 3;
    crowd.levels = "basis";
    crowd.more = shapes;
    return crowd;
  }
  void run(const std::string& meshes, Replace replace = Replace::kRefuse) {
    testing::run(folder_, {"output.meshes=" + meshes}, replace);
  }
  fs::path mesh(const std::string& name) const { return folder_.out() / "meshes" / name; }

  SmallCrowdFolder folder_;
};

struct Record {
  std::uint32_t shape, vertex;
  std::array<float, 3> delta;
};

std::vector<Record> read_records(const fs::path& path) {
  testing::BinaryReader file(testing::read_text(path));
  file.go_to(8);
  const std::string header = file.next_text(file.next<std::uint16_t>());
  EXPECT_THAT(header, HasSubstr("[('shape', '<u4'), ('vertex', '<u4'), ('delta', '<f4', (3,))]"));
  std::vector<Record> records;
  while (!file.at_end()) {
    const auto shape = file.next<std::uint32_t>(), vertex = file.next<std::uint32_t>();
    records.push_back({shape, vertex, testing::next_triple(file)});
  }
  EXPECT_THAT(header, HasSubstr(concat("'shape': (", records.size(), ",)")));
  return records;
}

// The files of a shape stayed when it was gone.
TEST_F(ShapesOfACrowd, ThatAreGoneLeaveNoFile) {
  run("[obj]");
  const std::string id = testing::plan_lines(folder_.out()).front().at("id");
  ASSERT_TRUE(fs::exists(mesh(id + "+other.obj")));
  folder_.folder().write("out/meshes/mine.obj", "somebody's own");
  fs::remove(folder_ / "shapes/other.obj");
  run("[obj]");
  EXPECT_FALSE(fs::exists(mesh(id + "+other.obj")));
  EXPECT_TRUE(fs::exists(mesh(id + ".obj")));
  EXPECT_TRUE(fs::exists(mesh("mine.obj")));
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
}

TEST_F(ShapesOfACrowd, AreTheSameInEveryFormat) {
  run("[obj, points, glb]");
  const std::string id = testing::plan_lines(folder_.out()).front().at("id");
  const auto face = reference::read_obj(mesh(id + ".obj")).vertices;
  const auto other = reference::read_obj(mesh(id + "+other.obj")).vertices;
  EXPECT_FALSE(fs::exists(mesh(id + "+still.obj")));

  std::set<std::size_t> moved;
  for (const Record& record : read_records(mesh(id + "+shapes.npy"))) {
    EXPECT_EQ(record.shape, 0U);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(face.at(record.vertex)[c] + static_cast<double>(record.delta[c]),
                  other.at(record.vertex)[c], 1e-5);
    }
    moved.insert(record.vertex);
  }
  EXPECT_GT(moved.size(), face.size() / 2);
  for (std::size_t v = 0; v < face.size(); ++v) {
    if (!moved.contains(v)) {
      EXPECT_EQ(face[v], other[v]);
    }
  }

  const testing::GlbFile glb = testing::read_glb(mesh(id + ".glb"));
  const auto& shape = glb.scene.at("meshes").at(0);
  EXPECT_THAT(shape.at("extras").at("targetNames").get<std::vector<std::string>>(),
              ElementsAre("other"));
  EXPECT_THAT(shape.at("weights").get<std::vector<double>>(), ElementsAre(0));
  const auto& targets = shape.at("primitives").at(0).at("targets");
  const auto& accessor =
      glb.scene.at("accessors").at(targets.at(0).at("POSITION").get<std::size_t>());
  testing::BinaryReader file(testing::read_text(mesh(id + ".glb")));
  file.go_to(12);
  const std::size_t buffer = 20 + file.next<std::uint32_t>() + 8;
  const auto view = [&](const char* part) {
    const auto number = accessor.at("sparse").at(part).at("bufferView").get<std::size_t>();
    file.go_to(buffer + glb.scene.at("bufferViews").at(number).at("byteOffset").get<std::size_t>());
  };
  const auto count = accessor.at("sparse").at("count").get<std::size_t>();
  view("indices");
  const auto indices = file.next_array<std::uint32_t>(count);
  EXPECT_TRUE(std::is_sorted(indices.begin(), indices.end()));
  EXPECT_GT(count, moved.size());  // seams split some
  view("values");
  for (const std::uint32_t index : indices) {
    const auto vertex = static_cast<std::size_t>(glb.ids.at(index));
    const auto delta = testing::next_triple(file);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(face.at(vertex)[c] + static_cast<double>(delta[c]), other.at(vertex)[c], 1e-5);
    }
  }
}

TEST_F(ShapesOfACrowd, AreRecordedVerifiedAndResumed) {
  run("[obj, points]");
  const auto whole = testing::crowd_files(folder_.out());
  EXPECT_TRUE(verify_crowd(folder_.out()).missing_files.empty());
  const std::string id = testing::plan_lines(folder_.out()).back().at("id");
  fs::remove(mesh(id + "+other.obj"));
  EXPECT_THAT(verify_crowd(folder_.out()).missing_files,
              ElementsAre("meshes/" + id + "+other.obj"));
  run("[obj, points]");
  EXPECT_THAT(testing::differing_files(whole, testing::crowd_files(folder_.out())), IsEmpty());
  EXPECT_EQ(testing::read_json(folder_.out() / "timings.json").at("faces"), 1);
}

TEST_F(ShapesOfACrowd, OtherShapesMakeTheFacesAnew) {
  run("[points]");
  folder_.folder().write("shapes/other.obj", testing::bowl_text(folder_.crowd().bowl, 41));
  run("[points]");
  EXPECT_EQ(testing::read_json(folder_.out() / "timings.json").at("faces"), 3);
}

TEST_F(ShapesOfACrowd, DoNotTouchTheFaces) {
  run("[obj]");
  const std::string id = testing::plan_lines(folder_.out()).front().at("id");
  const std::string face = testing::read_text(mesh(id + ".obj"));
  folder_.configure(crowd(""));
  run("[obj]", Replace::kForce);
  EXPECT_EQ(testing::read_text(mesh(id + ".obj")), face);
  EXPECT_FALSE(fs::exists(mesh(id + "+other.obj")));  // the other crowd's are removed
}

TEST_F(ShapesOfACrowd, AreTheShapesThemselvesOnTheTemplate) {
  SmallCrowd crowd = ShapesOfACrowd::crowd(kShapes);
  crowd.count = 0;
  crowd.more +=
      "\nrecipes: [{id: herself, target: ann, regions: {all: {iterations: 0, extrapolation: 1}}}]";
  folder_.configure(crowd);
  run("[obj]");
  const auto shape = reference::read_obj(folder_ / "shapes/other.obj").vertices;
  const auto carried = reference::read_obj(mesh("herself+other.obj")).vertices;
  for (std::size_t v = 0; v < shape.size(); ++v) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(carried[v][c], shape[v][c], 1e-5) << v;
  }
}

constexpr const char* kOfHeads = "\nshapes: {heads: sets}";

/// Each head with expressions of its own: one becomes ever another person, and one stays.
class ShapesOfHeads : public ShapesOfACrowd {
 protected:
  ShapesOfHeads() {
    std::uint64_t person = 40;
    for (const std::string& head : folder_.names()) {
      const std::string of_head = "sets/" + head;
      folder_.folder().write(of_head + "/other.obj",
                             testing::bowl_text(folder_.crowd().bowl, person++));
      folder_.folder().write(of_head + "/still.obj", testing::read_text(folder_.head(head)));
    }
    folder_.configure(crowd(kOfHeads));
  }
  /// A crowd of one face that is one of the heads.
  void cast_only(const std::string& head, const std::string& shapes = kOfHeads) {
    SmallCrowd crowd = ShapesOfACrowd::crowd(shapes.c_str());
    crowd.count = 0;
    crowd.more += "\nrecipes: [{id: same, target: " + head + ", regions: {all: {weights: {" + head +
                  ": 1}, iterations: 20, "
                  "extrapolation: 1}}}]";
    folder_.configure(crowd);
  }
  void expect_shape(const fs::path& expected) {
    const auto shape = reference::read_obj(expected).vertices;
    const auto carried = reference::read_obj(mesh("same+other.obj")).vertices;
    for (std::size_t v = 0; v < shape.size(); ++v) {
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(carried[v][c], shape[v][c], 2e-5) << v;
    }
  }
};

TEST_F(ShapesOfHeads, AreThoseOfTheHeadThatAFaceIs) {
  for (const std::string& head : {folder_.names().front(), folder_.names().back()}) {
    cast_only(head);
    run("[obj]", Replace::kForce);
    expect_shape(folder_ / ("sets/" + head + "/other.obj"));
    EXPECT_FALSE(fs::exists(mesh("same+still.obj")));
  }
}

TEST_F(ShapesOfHeads, MakeFacesWithShapesBetweenThem) {
  run("[obj, points]");
  for (const auto& line : testing::plan_lines(folder_.out())) {
    const std::string id = line.at("id");
    EXPECT_FALSE(fs::exists(mesh(id + "+still.obj")));
    EXPECT_NE(testing::read_text(mesh(id + "+other.obj")), testing::read_text(mesh(id + ".obj")));
  }
  EXPECT_THAT(testing::read_text(folder_.out() / "config.yaml"), HasSubstr("heads: ../sets"));
}

TEST_F(ShapesOfHeads, ThatAHeadLacksAreNamed) {
  const std::string head = folder_.names().at(1);
  fs::remove(folder_ / ("sets/" + head + "/other.obj"));
  testing::expect_error(ExitCode::kMissingInput, {"sets/" + head + " has no other.obj"},
                        [&] { run("[obj]"); });
  fs::remove_all(folder_ / ("sets/" + head));
  testing::expect_error(ExitCode::kMissingInput, {"sets/" + head}, [&] { run("[obj]"); });
}

TEST_F(ShapesOfHeads, ThatAHeadLacksAreCarriedFromTheTemplate) {
  const std::string head = folder_.names().at(1);
  const std::string with_template =
      "\nshapes: {neutral: heads/" + head + ".obj, directory: shapes, heads: sets}";
  fs::remove_all(folder_ / ("sets/" + head));
  cast_only(head, with_template);
  run("[obj]");
  expect_shape(folder_ / "shapes/other.obj");
  cast_only(folder_.names().front(), with_template);
  run("[obj]", Replace::kForce);
  expect_shape(folder_ / ("sets/" + folder_.names().front() + "/other.obj"));
}

TEST_F(ShapesOfACrowd, OfAnotherTopologyAreRefused) {
  folder_.folder().write("shapes/coarse.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  testing::expect_error(ExitCode::kBadData, {"coarse.obj: not the same mesh as"},
                        [&] { run("[obj]"); });
  EXPECT_FALSE(fs::exists(folder_.out()));
}

TEST_F(ShapesOfACrowd, ThatAreNotThereAreRefused) {
  folder_.configure(crowd("\nshapes: {neutral: heads/nobody.obj, directory: nowhere}"));
  testing::expect_error(ExitCode::kMissingInput, {"nobody.obj", "nowhere"}, [&] { run("[obj]"); });
}

}  // namespace
}  // namespace crowdface
