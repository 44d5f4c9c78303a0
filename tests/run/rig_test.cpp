// SPDX-License-Identifier: Apache-2.0
// A template's rig on the faces of a crowd.
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/glb_container.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/gltf_rig.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/run/crowd_glb_options.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/mesh_files.h"
#include "support/small_crowd.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
  }
}

/// The head ann with a neck, and a jaw that hangs on it; what is lower hears more of the jaw.
class RigOfACrowd : public ::testing::Test {
 protected:
  RigOfACrowd() : folder_(crowd("")) {
    const Job job = load_job(folder_.config(), {}, folder_.cache());
    const Positions& ann = job.inputs.head_set.heads.front().positions;
    GlbOptions options = glb_options(job.config, job.inputs);
    Eigen::Matrix3d turned;
    turned << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    options.skin.joints = {{"neck", kNoIndex, turned}, {"jaw", 0, Eigen::Matrix3d::Identity()}};
    const double low = ann.col(1).minCoeff(), high = ann.col(1).maxCoeff();
    for (Index v = 0; v < ann.rows(); ++v) {
      const auto jaw = static_cast<float>((high - ann(v, 1)) / (high - low));
      std::vector<Influence> of;
      if (jaw < 1) of.push_back({0, 1 - jaw});
      if (jaw > 0) of.push_back({1, jaw});
      options.skin.influences.add_group(of);
    }
    Positions joints(2, 3);
    joints << 0, -2, -0.5, 0.25, -0.5, 0.5;
    const Topology& topology = job.inputs.head_set.topology;
    const GlbTemplate form(topology, job.inputs.head_set.uvs, options);
    form.encode(ann, vertex_normals(NormalFans(topology), topology, ann), "rig", {}, {}, {}, {},
                joints)
        .write(folder_.folder() / "rig.glb");
    write_file(folder_.config(), testing::read_text(folder_.config()) + "\nrig: rig.glb\n");
  }
  static SmallCrowd crowd(const std::string& more) {
    SmallCrowd crowd;
    crowd.count = 2;
    crowd.levels = "basis";
    crowd.more = more +
                 "\nrecipes: [{id: herself, target: ann, regions: {all: {iterations: 0, "
                 "extrapolation: 1}}}]";
    return crowd;
  }
  void run(std::vector<std::string> set = {}) {
    set.push_back("output.meshes=[glb]");
    testing::run(folder_, set, Replace::kForce);
  }
  fs::path mesh(const std::string& id) const { return folder_.out() / "meshes" / (id + ".glb"); }
  fs::path rig() const { return folder_.folder() / "rig.glb"; }
  /// A file whose jaw is open by 30 degrees, about its x axis.
  fs::path with_open_jaw(const fs::path& file) const {
    std::string bytes = testing::read_text(file);
    const std::size_t node = bytes.find("\"name\":\"jaw\"");
    const std::size_t at = bytes.find("\"rotation\":[", node);
    const std::size_t end = bytes.find(']', at);
    // In the neck's axes, which are turned by a right angle about z.
    std::string turn = "\"rotation\":[0.1830127,-0.1830127,-0.6830127,0.6830127";
    EXPECT_LE(turn.size(), end - at);
    turn.resize(end - at, ' ');
    bytes.replace(at, end - at, turn);
    fs::path opened = folder_.folder() / "opened.glb";
    write_file(opened, bytes);
    return opened;
  }

  SmallCrowdFolder folder_;
};

// A rig whose matrices are zero, or make the mesh tiny and far away, was found out by the faces
// made with it.
TEST_F(RigOfACrowd, ThatDoesNotStandWhereHeadsDoIsRefused) {
  const std::string bytes = testing::read_text(rig());
  const auto scene = testing::read_glb(rig()).scene;
  const auto& accessor =
      scene.at("accessors")
          .at(scene.at("skins").at(0).at("inverseBindMatrices").get<std::size_t>());
  const auto& view = scene.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  std::uint32_t json = 0;
  std::memcpy(&json, bytes.data() + 12, sizeof json);
  const std::size_t at = 28 + json + view.value("byteOffset", std::size_t{0}) +
                         accessor.value("byteOffset", std::size_t{0});
  for (const auto& [scale, shift] : {std::pair{0.0F, 0.0F}, {1e-5F, 1e5F}, {1.0F, 1e5F}}) {
    std::string other = bytes;
    for (std::size_t i = 0; i < 32; ++i) {
      float value = 0;
      std::memcpy(&value, &other[at + 4 * i], sizeof value);
      value = i % 16 == 12 ? scale * value + shift : i % 16 == 15 ? value : scale * value;
      std::memcpy(&other[at + 4 * i], &value, sizeof value);
    }
    write_file(rig(), other);
    testing::expect_error(ExitCode::kBadData, {"rig.glb", "mm"},
                          [&] { load_job(folder_.config(), {}, folder_.cache()); });
  }
}

TEST_F(RigOfACrowd, MayBeGivenToAFinishedCrowdAndTakenBack) {
  const std::string with = testing::read_text(folder_.config());
  const std::string rig_line = "\nrig: rig.glb\n";
  write_file(folder_.config(), with.substr(0, with.size() - rig_line.size()));
  const std::vector<std::string> formats = {"output.meshes=[obj, glb]"};
  testing::run(folder_, formats);
  const auto plain = testing::crowd_files(folder_.out());
  write_file(folder_.config(), with);
  testing::run(folder_, formats);
  const auto rigged = testing::crowd_files(folder_.out());
  EXPECT_NE(rigged.at("meshes/mob_0001.glb"), plain.at("meshes/mob_0001.glb"));
  for (const char* same : {"meshes/mob_0001.obj", "plan.jsonl", "crowd.csv"}) {
    EXPECT_EQ(rigged.at(same), plain.at(same)) << same;
  }
  testing::run_to(folder_, "again", ConfigOverrides{formats, {}, {}, {}});
  EXPECT_THAT(testing::differing_files(testing::crowd_files(folder_ / "again"), rigged),
              ::testing::IsEmpty());
  testing::run(folder_, {formats.front(), "rig=none"});
  EXPECT_THAT(testing::differing_files(plain, testing::crowd_files(folder_.out())),
              ::testing::IsEmpty());
}

TEST_F(RigOfACrowd, StandsOnTheTemplateAsItWas) {
  run();
  const GltfRig given = read_gltf_rig(rig()), own = read_gltf_rig(mesh("herself"));
  ASSERT_EQ(own.joints.size(), 2U);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(own.joints[j].name, given.joints[j].name);
    EXPECT_EQ(own.joints[j].parent, given.joints[j].parent);
    EXPECT_LT((own.joints[j].rest_transform - given.joints[j].rest_transform).cwiseAbs().maxCoeff(),
              1e-5)
        << j;
  }
  EXPECT_LT((own.positions - given.positions).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(RigOfACrowd, BendsFacesAsTheTemplate) {
  run();
  for (const auto& line : testing::plan_lines(folder_.out())) {
    const fs::path file = mesh(line.at("id"));
    const GltfRig rest = read_gltf_rig(file), given = read_gltf_rig(rig());
    const GltfRig open = read_gltf_rig(with_open_jaw(file));
    const Eigen::Vector3d pivot = rest.joints[1].rest_transform.col(3).head<3>();
    double moved = 0;
    for (Index v = 0; v < rest.positions.rows(); ++v) {
      const auto of = rest.influences.items_of(v);
      ASSERT_EQ(of.size(), given.influences.items_of(v).size());
      double jaw = 0;
      for (const Influence& one : of) {
        if (one.joint == 1) jaw = static_cast<double>(one.weight);
      }
      const Eigen::Vector3d from = row3(rest.positions, v) - pivot;
      const Eigen::Vector3d turned(from.x(), std::cos(M_PI / 6) * from.y() - 0.5 * from.z(),
                                   0.5 * from.y() + std::cos(M_PI / 6) * from.z());
      const Eigen::Vector3d wanted = pivot + (1 - jaw) * from + jaw * turned;
      EXPECT_LT((row3(open.positions, v) - wanted).norm(), 1e-5);
      moved = std::max(moved, (row3(open.positions, v) - row3(rest.positions, v)).norm());
    }
    EXPECT_GT(moved, 1e-3);
  }
}

TEST_F(RigOfACrowd, IsFoundByPlaceWithoutVertexIds) {
  std::string bytes = testing::read_text(rig());
  replace_all(bytes, "_VERTEX_ID", "_SOMETHING");
  write_file(rig(), bytes);
  run();
  const GltfRig own = read_gltf_rig(mesh("herself")), given = read_gltf_rig(rig());
  EXPECT_LT((own.positions - given.positions).cwiseAbs().maxCoeff(), 1e-5);
  for (Index v = 0; v < own.positions.rows(); ++v) {
    ASSERT_EQ(own.influences.items_of(v).size(), given.influences.items_of(v).size());
    EXPECT_EQ(own.influences.items_of(v)[0].weight, given.influences.items_of(v)[0].weight);
  }
}

TEST_F(RigOfACrowd, OfAnotherMeshIsRefused) {
  std::string bytes = testing::read_text(rig());
  replace_all(bytes, "_VERTEX_ID", "_SOMETHING");
  write_file(rig(), bytes);
  // Metres are then no longer what they were.
  testing::expect_error(ExitCode::kBadData, {"rig.glb", "match no vertex"},
                        [&] { run({"faces.units=mm"}); });
  write_file(rig(), bytes.substr(0, bytes.size() / 2));
  testing::expect_error(ExitCode::kBadData, {"rig.glb", "GLB"}, [&] { run(); });
}

/// Each was read from beyond its memory, or for ever.
TEST(GltfRig, BrokenScenesAreRefused) {
  const testing::TemporaryFolder folder;
  const auto refuse = [&](std::string gltf, std::initializer_list<std::string> words) {
    gltf.resize((gltf.size() + 3) / 4 * 4, ' ');
    const std::array<float, 12> floats = {0, 0, 0, -1, 0, 0, 0, 1, NAN, 0, 0, 1};
    const std::uint32_t binary = sizeof floats;
    std::string bytes;
    append_number(bytes, glb::kMagic);
    append_number(bytes, glb::kContainerVersion);
    append_number(bytes,
                  static_cast<std::uint32_t>(glb::kBinaryHeaderSize + gltf.size() + sizeof floats));
    append_number(bytes, static_cast<std::uint32_t>(gltf.size()));
    append_number(bytes, glb::kJsonChunk);
    bytes += gltf;
    append_number(bytes, binary);
    append_number(bytes, glb::kBinaryChunk);
    for (const float number : floats) append_number(bytes, number);
    write_file(folder / "rig.glb", bytes);
    testing::expect_error(ExitCode::kBadData, words, [&] { read_gltf_rig(folder / "rig.glb"); });
  };
  const auto scene = [](const std::string& nodes, const std::string& more) {
    return R"({"nodes":[)" + nodes + R"(],"skins":[{"joints":[0]}],"meshes":[{"primitives":[)" +
           R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],"buffers":[{"byteLength":48}],)" +
           R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":12,"byteLength":36},)" +
           R"({"buffer":0,"byteOffset":16,"byteLength":32},{"buffer":0,"byteLength":48,"byteStride":0}],)" +
           R"("accessors":[)" + more + "]}";
  };
  const std::string position = R"({"bufferView":0,"componentType":5126,"count":1})";
  const std::string weights = R"(,{"bufferView":2,"componentType":5126,"count":1})";
  refuse(scene(R"({},{"children":[2]},{"children":[1],"mesh":0})", position), {"form a cycle"});
  refuse(scene(R"({"matrix":[1,0,0]})", position), {"16 numbers in the matrix"});
  refuse(scene(R"({},{"mesh":0,"skin":0})", R"({"bufferView":3,"componentType":5126,"count":40})"),
         {"accessor 0", "beyond the end of its buffer view"});
  refuse(scene(R"({},{"mesh":0,"skin":0})",
               position + R"(,{"bufferView":1,"componentType":5126,"count":1})" + weights),
         {"accessor 1", "expected whole numbers"});
  refuse(scene(R"({},{"mesh":0,"skin":0})",
               R"({"bufferView":2,"byteOffset":12,"componentType":5126,"count":1})"),
         {"accessor 0", "not finite"});
  refuse(scene(R"({},{"mesh":0,"skin":7})", position), {"valid glTF 2.0 scene", "7"});
  refuse(scene(R"({"translation":[1e300,0,0]})", position), {"node 0", "out of range"});
  refuse(scene(concat(R"({"name":")", std::string(1001, 'n'), R"("})"), position),
         {"at most 1000 bytes, found 1001"});
  refuse(scene(R"({"children":[1]},{"mesh":0})", position)
             .replace(
                 0, 1,
                 R"({"x":{"":0)" +
                     [] {
                       std::string keys;
                       for (int k = 0; k < 2000; ++k) keys += concat(R"(,"k)", k, R"(":0)");
                       return keys + "},";
                     }()),
         {"JSON that cannot be read"});

  // One megabyte became gigabytes.
  constexpr const char* kOften = "far more numbers";
  std::string many = R"({"children":[1)", nodes;
  for (int n = 1; n <= 65; ++n) nodes += R"(,{"mesh":0})";
  for (int n = 2; n <= 65; ++n) many += concat(",", n);
  const std::string zeros = R"({"componentType":5126,"count":70000})";
  refuse(scene(many + "]}" + nodes, zeros), {kOften});
  std::string sets;
  for (int n = 1; n <= 24; ++n) sets += concat(R"(,"JOINTS_)", n, R"(":1,"WEIGHTS_)", n, R"(":1)");
  const std::string bytes = R"(,{"componentType":5121,"count":70000})";
  const auto with = [](std::string gltf, const std::string& after, const std::string& more) {
    return gltf.insert(gltf.find(after) + after.size(), more);
  };
  refuse(with(scene(R"({},{"mesh":0,"skin":0})", zeros + bytes + "," + zeros), R"("WEIGHTS_0":2)",
              sets),
         {kOften});
  refuse(with(scene(R"({"children":[1]},{"mesh":0})",
                    position + R"(,{"bufferView":1,"componentType":5121,"count":9})"),
              R"("POSITION":0)", R"(,"_VERTEX_ID":1)"),
         {"_VERTEX_ID and POSITION differ in length"});
}

}  // namespace
}  // namespace crowdface
