// SPDX-License-Identifier: Apache-2.0
// Whole runs whose faces are mirrored, or more or less asymmetric.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/heads/head_mirror.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/mesh/mirror_map.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"
#include "head_models/synth/synthetic_head.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/reference.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using json = nlohmann::json;
using testing::crowd_files;
using testing::plan_lines;

/// A folder of synthetic heads, with eyes and teeth. \param left  how wide their left half is.
class Heads {
 public:
  explicit Heads(Index vertices = 5000, Index count = 5, double left = 1) {
    const SyntheticHeads synthetic(vertices, SyntheticHeads::Parts::kEyesAndTeeth);
    std::filesystem::create_directories(folder_ / "heads");
    for (Index h = 0; h < count; ++h) {
      Mesh mesh{synthetic.topology(), synthetic.positions(5, static_cast<std::uint64_t>(h)),
                synthetic.uvs()};
      for (Index v = 0; v < mesh.positions.rows(); ++v) {
        double& x = mesh.positions(v, 0);
        x *= x > 0 ? left : 1;
      }
      encode_obj(mesh, "").write(folder_ / concat("heads/head_", h, ".obj"));
    }
  }
  /// \param more  sections of the config; \return the crowd's folder
  std::filesystem::path run(const std::string& more, const std::string& name,
                            Replace replace = Replace::kRefuse) const {
    generate(config(more, name), {}, {folder_ / "cache", replace, false});
    return folder_ / name;
  }
  std::filesystem::path config(const std::string& more, const std::string& name) const {
    return folder_.write(
        concat(name, ".yaml"),
        concat("schema: 1\ncrowd: {name: mob, count: 6, seed: 3}\nfaces: {directory: heads, ",
               "align: none, units: cm}\nsmoothing: {levels: exact}\n",
               "output: {directory: ", name, ", contact_sheet: none}\n", more));
  }
  const testing::TemporaryFolder& folder() const { return folder_; }

 private:
  testing::TemporaryFolder folder_;
};

Positions mesh_of(const std::filesystem::path& crowd, const std::string& id) {
  const reference::Points points = reference::read_obj(crowd / "meshes" / (id + ".obj")).vertices;
  Positions positions(static_cast<Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    for (std::size_t c = 0; c < 3; ++c) {
      positions(static_cast<Index>(v), static_cast<Index>(c)) = points[v][c];
    }
  }
  return positions;
}

constexpr const char* kMirrored = "sampling: {asymmetry: [0.4, 1.3], mirror: drawn}\n";

TEST(GenerateMirror, ARecipeIsMirroredWithItsParts) {
  const Heads heads;
  const std::string face =
      "target: head_1, regions: {all: {weights: {head_2: 1}, smoothness: 0.6, extrapolation: 1.1}}";
  const auto out = heads.run(
      concat("recipes: [{id: plain, ", face, "}, {id: image, mirrored: true, ", face,
             "}, {id: even, asymmetry: 0, ", face, "}, {id: half, asymmetry: 0.5, ", face, "}]\n"),
      "out");
  const Job job = load_job(heads.folder() / "out.yaml", {});
  ASSERT_NE(job.inputs.mirror_map, nullptr);
  const MirrorMap& map = *job.inputs.mirror_map;
  const Positions plain = mesh_of(out, "plain"), image = mesh_of(out, "image");
  constexpr double kSingle = 4e-6;  // two units in the last place of some 20 cm
  EXPECT_LT((mirrored(map, plain) - image).cwiseAbs().maxCoeff(), kSingle);
  EXPECT_GT((plain - image).cwiseAbs().maxCoeff(), 0.05);
  const Positions even = mesh_of(out, "even"), half = mesh_of(out, "half");
  const Positions off = mirrored(map, even) - even;
  double skin = 0;
  for (std::size_t v = 0; v < job.inputs.skin_components.component_of_vertex.size(); ++v) {
    if (job.inputs.skin_components.component_of_vertex[v] != job.inputs.skin_components.largest())
      continue;
    skin = std::max(skin, off.row(static_cast<Index>(v)).norm());
  }
  EXPECT_LT(skin, 0.03) << "but for lips, which are brought to their gaps on either side";
  EXPECT_LT((half - plain).norm(), (even - plain).norm());
  const auto lines = plan_lines(out);
  EXPECT_EQ(lines[1].at("mirrored"), true);
  EXPECT_EQ(lines[2].at("asymmetry"), 0.0);
  EXPECT_FALSE(lines[0].contains("mirrored") || lines[0].contains("asymmetry"));
  EXPECT_EQ(lines[0].at("regions"), lines[1].at("regions"));
}

TEST(GenerateMirror, SwitchedOffChangesNothing) {
  const Heads heads;
  const auto plain = heads.run("", "a");
  const auto off = heads.run("sampling: {asymmetry: 1, mirror: none}\n", "b");
  for (const char* file :
       {"plan.jsonl", "crowd.csv", "meshes/mob_0001.obj", "meshes/mob_0006.obj"}) {
    EXPECT_EQ(testing::read_text(plain / file), testing::read_text(off / file)) << file;
  }
  EXPECT_EQ(testing::read_text(plain / "config.yaml").find("mirror"), std::string::npos);
}

TEST(GenerateMirror, ARunGoesOnWhereItWasAndIsVerified) {
  for (const Index vertices : {5000, 20000}) {
    const Heads heads(vertices, 4);
    const auto out = heads.run(kMirrored, "out");
    const auto lines = plan_lines(out);
    std::set<bool> sides;
    for (const json& line : lines) {
      sides.insert(line.contains("mirrored"));
      EXPECT_GE(line.at("asymmetry"), 0.4);
      EXPECT_LE(line.at("asymmetry"), 1.3);
    }
    EXPECT_EQ(sides.size(), 2U) << "seed 3 draws both";
    EXPECT_NE(testing::read_text(out / "crowd.csv").find("asymmetry,mirrored"), std::string::npos);
    const auto whole = crowd_files(out);
    std::filesystem::remove(out / "meshes/mob_0002.obj");
    std::filesystem::remove(out / "plan.jsonl");
    heads.run(kMirrored, "out");
    EXPECT_THAT(testing::differing_files(crowd_files(out), whole), ::testing::IsEmpty());
    EXPECT_TRUE(verify_crowd(out).is_intact());
  }
}

TEST(GenerateMirror, ALockedFaceKeepsItsSideAndAFamilySharesOne) {
  const Heads heads;
  const std::string banded =
      "sampling: {asymmetry: [0.4, 1.3], mirror: drawn, bands: {build: 0.7, skin: {smoothness: "
      "0.1}}}\n"
      "families: [{name: kin, members: 3, max_distance: 4 mm}]\nbelievability: none\n";
  const auto out = heads.run(banded, "out");
  const auto before = plan_lines(out);
  std::set<bool> sides;
  for (const json& line : before) {
    if (line.at("family") == "kin") sides.insert(line.contains("mirrored"));
  }
  EXPECT_EQ(sides.size(), 1U);
  std::string locks;
  for (const json& line : before) {
    if (!line.at("family").is_null()) continue;
    locks += concat(line.at("id").get<std::string>(), ": {lock: [skin]}, ");
  }
  heads.folder().write("review.yaml", concat("schema: 1\nfaces: {", locks, "}\n"));
  heads.run(banded + "review: review.yaml\n", "out", Replace::kForce);
  const auto after = plan_lines(out);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].contains("mirrored"), before[i].contains("mirrored"));
    EXPECT_EQ(after[i].at("asymmetry"), before[i].at("asymmetry"));
    if (before[i].at("family").is_null()) {
      EXPECT_NE(after[i].at("regions"), before[i].at("regions"));
    }
  }
}

TEST(GenerateMirror, HeadsThatAreNotSymmetricAreRefused) {
  const Heads heads(5000, 2, 2.5);
  const std::map<std::string, std::string> cases = {{"{mirror: drawn}", "sampling.mirror"},
                                                    {"{asymmetry: 0.5}", "sampling.asymmetry"}};
  for (const auto& one : cases) {
    testing::expect_error(ExitCode::kBadData, {one.second, "not symmetric enough", "90 %"},
                          [&] { heads.run(concat("sampling: ", one.first, "\n"), "out"); });
  }
  EXPECT_NO_THROW(heads.run("", "plain"));
}

TEST(GenerateMirror, KeepLeftShapesOnTheirLeft) {
  const Heads heads;
  const SyntheticHeads synthetic(5000, SyntheticHeads::Parts::kEyesAndTeeth);
  Mesh mesh{synthetic.topology(), synthetic.positions(5, 0), synthetic.uvs()};
  const Positions rest = mesh.positions;
  constexpr double kLeftFrom = 3;
  for (Index v = 0; v < rest.rows(); ++v) {
    if (rest(v, 0) > kLeftFrom) mesh.positions(v, 1) += 0.1 * (rest(v, 0) - kLeftFrom);
  }
  std::filesystem::create_directories(heads.folder() / "shapes");
  encode_obj(mesh, "").write(heads.folder() / "shapes/left.obj");
  const std::string face = "target: head_0, regions: {all: {iterations: 0, extrapolation: 1}}";
  const auto out = heads.run(
      concat("shapes: {neutral: heads/head_0.obj, directory: shapes}\n", "recipes: [{id: plain, ",
             face, "}, {id: image, mirrored: true, ", face, "}]\n"),
      "acting");
  for (const std::string id : {"plain", "image"}) {
    const Positions at_rest = mesh_of(out, id), acting = mesh_of(out, id + "+left");
    double left = 0;
    for (Index v = 0; v < rest.rows(); ++v) {
      const double moved = (acting.row(v) - at_rest.row(v)).norm();
      if (rest(v, 0) <= kLeftFrom) {
        EXPECT_EQ(moved, 0) << id << ' ' << v;
      }
      if (moved > 0) {
        EXPECT_GT(at_rest(v, 0), 0) << id << ' ' << v;
      }
      left = std::max(left, moved);
    }
    const double wanted = (mesh.positions - rest).rowwise().norm().maxCoeff();
    EXPECT_NEAR(left, wanted, 0.25 * wanted) << id;
  }
}

}  // namespace
}  // namespace crowdface
