// SPDX-License-Identifier: Apache-2.0
// The same comparison on real heads, where they are at hand: sixteen identities of the ICT face
// model, 26,719 vertices each, which are not kept in this repository.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/run/generate.h"

#include "support/bowl_heads.h"
#include "support/crowd_files.h"
#include "support/reference_distance.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

class RealHeads : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(heads / "ict_00.obj")) {
      GTEST_SKIP() << "no real heads at " << heads << ": put OBJ files ict_00.obj … there";
    }
  }
  const fs::path heads = fs::path(CROWDFACE_SOURCE_DIR) / "../shared/faces/ict16";
};

TEST_F(RealHeads, MatchThePlainMethod) {
  const testing::TemporaryFolder folder;
  const std::vector<std::string> names = {"ict_00", "ict_03", "ict_07", "ict_12"};
  std::vector<std::string> files;
  for (const std::string& name : names) files.push_back((heads / (name + ".obj")).string());
  reference::Mask mask;
  for (int tile = 1001; tile <= 1007; ++tile) {
    mask[tile] = testing::mask_picture(24, 24, static_cast<std::uint64_t>(tile));
    testing::write_mask(folder / concat("bands.", tile, ".png"), mask[tile]);
  }
  const fs::path config = folder.write(
      "config.yaml",
      concat("schema: 1\ncrowd: {name: real, count: 3, seed: 5}\nfaces: {files: [", join(files),
             "], units: cm}\n", "regions: {names: [top, middle, bottom], mask: bands.<UDIM>.png}\n",
             "smoothing: {boundary: fixed, operator: umbrella, levels: exact}\nparts: none\n",
             "blending: {contacts: none}  # the equations and nothing else\n",
             "sampling: {smoothness: [0.1, 0.6], extrapolation: [0.9, 1.2], max_sources: 2}\n",
             "output: {directory: out, contact_sheet: none}\n"));
  generate(config, {}, {folder / "cache", Replace::kRefuse, false});

  reference::Heads reference;
  reference::Obj mesh;
  for (std::size_t h = 0; h < names.size(); ++h) {
    mesh = reference::read_obj(files[h]);
    reference.positions[names[h]] = mesh.vertices;
  }
  reference.filter = reference::make_filter(mesh, true, false);
  reference.regions = {"top", "middle", "bottom"};
  reference.alpha = reference::masks_at_vertices(mesh, {mask}, 3);
  const auto lines = testing::plan_lines(folder / "out");
  ASSERT_EQ(lines.size(), 3U);
  for (const auto& line : lines) {
    const fs::path path = folder / concat("out/meshes/", line.at("id").get<std::string>(), ".obj");
    EXPECT_LT(reference::largest_difference(reference::read_obj(path).vertices,
                                            reference::blend(reference, line)),
              2e-5);
    testing::expect_same_but_positions(heads / (line.at("target").get<std::string>() + ".obj"),
                                       path);
  }
}

/// What casting says of a crowd from recipes and samples, measured on every vertex of the meshes
/// that were written; and what the default settings promise.
TEST_F(RealHeads, DefaultsCastFarAndDistancesAreThoseOfTheMeshes) {
  const testing::TemporaryFolder folder;
  const fs::path config = folder.write(
      "config.yaml", concat("schema: 1\ncrowd: {name: real, count: 100, seed: 11}\n",
                            "faces: {directory: ", heads.string(), ", units: cm}\n",
                            "sampling: {extrapolation: 1}\n",  // as built and at 1 are the same
                            "output: {directory: out, contact_sheet: none}\n"));
  generate(config, {}, {folder / "cache", Replace::kRefuse, false});

  std::map<std::string, reference::Points> inputs;
  std::vector<reference::Points> all;
  for (const auto& file : fs::directory_iterator(heads)) {
    if (file.path().extension() != ".obj") continue;
    all.push_back(reference::read_obj(file.path()).vertices);
    inputs[file.path().stem().string()] = all.back();
  }
  const std::vector<double> areas =
      reference::front_areas(reference::read_obj(heads / "ict_00.obj"), all);
  constexpr double kMmPerUnit = 10;
  const auto between = [&](const reference::Points& a, const reference::Points& b) {
    return reference::distance_mm(areas, a, b, kMmPerUnit);
  };
  const auto lines = testing::plan_lines(folder / "out");
  ASSERT_EQ(lines.size(), 100U);
  std::vector<reference::Points> crowd;
  std::vector<double> distances, of_inputs;
  for (const auto& line : lines) {
    const fs::path path = folder / concat("out/meshes/", line.at("id").get<std::string>(), ".obj");
    crowd.push_back(reference::read_obj(path).vertices);
    const reference::Points& face = crowd.back();
    const auto& nearest = line.at("nearest");
    const double to_head = between(face, inputs.at(nearest.at("face").get<std::string>()));
    EXPECT_NEAR(nearest.at("face_mm").get<double>(), to_head, 0.02 * to_head);
    if (crowd.size() == 1) continue;
    double closest = HUGE_VAL;
    for (std::size_t j = 0; j + 1 < crowd.size(); ++j) {
      distances.push_back(between(face, crowd[j]));
      closest = std::min(closest, distances.back());
    }
    EXPECT_NEAR(nearest.at("crowd_mm").get<double>(), closest, 0.02 * closest);
  }
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) of_inputs.push_back(between(all[a], all[b]));
  }
  std::sort(distances.begin(), distances.end());
  std::sort(of_inputs.begin(), of_inputs.end());
  EXPECT_GE(distances.front(), 2) << "no pair of one face for two";
  EXPECT_GE(distances[distances.size() / 2], 0.8 * of_inputs[of_inputs.size() / 2]);
}

/// What makes a family one, measured on every vertex of the meshes.
TEST_F(RealHeads, ChildrenSiblingsAndCousinsAreAsNearAsTheyShouldBe) {
  const testing::TemporaryFolder folder;
  const fs::path config = folder.write(
      "config.yaml",
      concat("schema: 1\ncrowd: {name: real, count: 200, seed: 3}\n", "faces: {directory: ",
             heads.string(), ", units: cm}\n", "sampling: {extrapolation: 1}\n",
             "families:\n"
             "  - {name: smith, members: 3, parents: {mother: drawn, father: drawn}}\n"
             "  - {name: green, members: 3, parents: {mother: smith_01, father: drawn}}\n"
             "  - {name: brown, members: 3, parents: {mother: drawn, father: smith_02}}\n"
             "output: {directory: out, contact_sheet: none}\n"));
  generate(config, {}, {folder / "cache", Replace::kRefuse, false});
  const reference::Obj mesh = reference::read_obj(heads / "ict_00.obj");
  const std::vector<double> areas = reference::front_areas(mesh, {mesh.vertices});
  const auto lines = testing::plan_lines(folder / "out");
  std::map<std::string, reference::Points> faces;
  std::vector<std::string> strangers;
  for (const auto& line : lines) {
    const auto id = line.at("id").get<std::string>();
    faces[id] = reference::read_obj(folder / concat("out/meshes/", id, ".obj")).vertices;
    if (!line.at("index").is_null()) strangers.push_back(id);
  }
  const auto mm = [&](const std::string& a, const std::string& b) {
    return reference::distance_mm(areas, faces.at(a), faces.at(b), 10);
  };
  for (const auto& line : lines) {
    if (!line.contains("parents")) continue;
    const auto id = line.at("id").get<std::string>();
    for (const auto& parent : line.at("parents")) {
      const double to_parent = mm(id, parent.get<std::string>());
      const auto nearer = std::count_if(strangers.begin(), strangers.end(), [&](const auto& other) {
        return mm(id, other) < to_parent;
      });
      EXPECT_LE(nearer, 20) << "of 200 strangers nearer to " << id << " than " << parent;
    }
  }
  const auto member = [](const std::string& family, int m) {
    return concat("real_", family, "_0", m);
  };
  double siblings = 0, cousins = 0, unrelated = 0;
  for (int a = 1; a <= 3; ++a) {
    for (int b = 1; b <= 3; ++b) {
      cousins += mm(member("green", a), member("brown", b)) / 9;
      if (a < b)
        siblings += (mm(member("green", a), member("green", b)) +
                     mm(member("brown", a), member("brown", b))) /
                    6;
    }
    for (const std::string& other : strangers) {
      unrelated += mm(member("green", a), other) / static_cast<double>(3 * strangers.size());
    }
  }
  EXPECT_LT(siblings, cousins);
  EXPECT_LT(cousins, unrelated);
}

TEST_F(RealHeads, NoMeshGoesBeyondALimitWhereMeshesAreJudged) {
  const testing::TemporaryFolder folder;
  const fs::path config = folder.write(
      "config.yaml", concat("schema: 1\ncrowd: {name: real, count: 30, seed: 11}\n",
                            "faces: {directory: ", heads.string(), ", units: cm}\n",
                            "sampling: {extrapolation: 1}\n",
                            "output: {directory: out, meshes: [points], contact_sheet: none}\n"));
  const auto beyond = [&](const std::string& meshes) {
    ConfigOverrides overrides;
    overrides.assignments = {"believability.meshes=" + meshes};
    generate(config, overrides, {folder / "cache", Replace::kForce, false});
    int count = 0;
    const auto report = testing::read_json(folder / "out/report.json");
    for (const auto& face : report.at("faces")) {
      const auto& skin = face.at("skin");
      const auto triangles = skin.at("triangles").get<double>();
      if (skin.at("flipped").get<double>() > 0.003 * triangles ||
          skin.at("intersecting").get<double>() > 0.01 * triangles ||
          skin.at("stretch").get<double>() > 3) {
        ++count;
      }
    }
    return count;
  };
  EXPECT_GT(beyond("all"), 0) << "else this crowd shows nothing";
  EXPECT_EQ(beyond("judge"), 0);
}

}  // namespace
}  // namespace crowdface
