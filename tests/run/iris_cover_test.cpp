// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/iris_cover.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/render/eyeballs.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"
#include "head_models/synth/synthetic_head.h"

#include "support/crowd_files.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::Not;

/// Synthetic heads, and hair that is one upright rectangle in front of the head.
class IrisCoverTest : public ::testing::Test {
 protected:
  static constexpr double kFarAhead = 3;  // centimetres in front of the eye's centre

  IrisCoverTest() {
    const SyntheticHeads synthetic(5000, SyntheticHeads::Parts::kEyesAndTeeth);
    fs::create_directories(folder_ / "heads");
    for (std::uint64_t h = 0; h < 4; ++h) {
      const Mesh mesh{synthetic.topology(), synthetic.positions(3, h + 1), synthetic.uvs()};
      encode_obj(mesh, "").write(folder_ / concat("heads/head_", h, ".obj"));
    }
    write_config("none");
    const Job job = load_job(folder_ / "config.yaml", {});
    for (const Part& part : job.inputs.parts.parts) {
      if (!part.is_eyeball) continue;
      const Positions eye = job.inputs.head_set.heads[0].positions(part.ball_vertices, Eigen::all);
      const Eigen::RowVector3d low = eye.colwise().minCoeff(), high = eye.colwise().maxCoeff();
      eye_centre_ = (low + high) / 2;
      iris_radius_ = kIrisRadius * (high - low).maxCoeff() / 2;
    }
  }
  void write_config(const std::string& attachments) {
    folder_.write("config.yaml", concat("schema: 1\ncrowd: {name: t, count: 8, seed: 5}\n",
                                        "faces: {directory: heads, units: cm}\nattachments: ",
                                        attachments, "\nrecipes: [{id: first, target: head_0}]\n",
                                        "output: {directory: out, contact_sheet: none}\n"));
  }
  /// Writes hair as a wide rectangle. Its right edge lies `beyond` iris radii to the right of the
  /// eye's centre.
  void write_hair(const std::string& name, double beyond, double ahead = kFarAhead,
                  double opacity = 1) {
    const double right = eye_centre_.x() + beyond * iris_radius_, left = right - 8 * iris_radius_;
    std::string text = concat("mtllib ", name, ".mtl\nusemtl hair\n");
    for (const auto& [x, up] : {std::pair(left, -2.0), {right, -2.0}, {right, 2.0}, {left, 2.0}}) {
      text += concat("v ", x, ' ', eye_centre_.y() + up, ' ', eye_centre_.z() + ahead, '\n');
    }
    folder_.write(name + ".obj", text + "f 1 2 3 4\n");
    folder_.write(name + ".mtl", concat("newmtl hair\nKd 1 1 1\nd ", opacity, '\n'));
  }
  /// The covered fraction on the face that is head_0 itself, wearing hair that was made for head_0.
  double covered_fraction() {
    write_config("{fitted_to: head_0, items: [{name: fringe, kind: hair, file: fringe.obj}]}");
    const Job job = load_job(folder_ / "config.yaml", {});
    const PreparedHeads prepared =
        prepare(job.config, job.inputs, job.smoothing, folder_ / "cache");
    const FaceBuilder builder(job.config, job.inputs, prepared);
    FaceAttachments attachments(job.config, job.inputs);
    IrisCover cover(job.config, job.inputs, attachments,
                    [&]() -> const FaceBuilder& { return builder; });
    FacePlan face;
    face.recipe.target = 0;
    face.recipe.regions.emplace_back().weights = {{0, 1.0}};
    return cover.covered_fraction("fringe", face);
  }
  std::vector<std::vector<std::string>> planned_attachments() const {
    plan(folder_ / "config.yaml", {}, {folder_ / "cache", Replace::kForce, false});
    const Job job = load_job(folder_ / "config.yaml", {}, folder_ / "cache");
    std::vector<std::vector<std::string>> worn;
    for (const PlanLine& line : read_plan(folder_ / "out/plan.jsonl", job.names)) {
      worn.push_back(line.face.attachments);
    }
    return worn;
  }

  testing::TemporaryFolder folder_;
  Eigen::RowVector3d eye_centre_;  ///< of the eye with the larger x, on head_0
  double iris_radius_ = 0;
};

TEST_F(IrisCoverTest, IsTheCoveredPartOfTheIris) {
  // An edge at distance t · r from the centre of a disc covers 1/2 + (t √(1 − t²) + asin t) / π.
  for (const double t : {-0.6, 0.05, 0.5}) {
    write_hair("fringe", t);
    const double expected = 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / std::numbers::pi;
    EXPECT_NEAR(covered_fraction(), expected, 0.06) << t;
  }
  write_hair("fringe", 1.3);
  EXPECT_DOUBLE_EQ(covered_fraction(), 1);
  write_hair("fringe", -1.3);
  EXPECT_DOUBLE_EQ(covered_fraction(), 0);
}

TEST_F(IrisCoverTest, TransparentHairCountsPartly) {
  write_hair("fringe", 1.3, kFarAhead, 0.25);
  EXPECT_NEAR(covered_fraction(), 0.25, 1e-6);
}

TEST_F(IrisCoverTest, HairBehindTheEyesCoversNothing) {
  write_hair("fringe", 1.3, -kFarAhead);
  EXPECT_EQ(covered_fraction(), 0);
}

TEST_F(IrisCoverTest, NoFaceWearsACutThatCoversAnEye) {
  write_hair("fringe", 0.3);
  write_hair("bob", -4);
  write_config(
      "{fitted_to: head_0, items: [{name: fringe, kind: hair, file: fringe.obj}, "
      "{name: bob, kind: hair, file: bob.obj}]}");
  for (const auto& worn : planned_attachments()) {
    EXPECT_THAT(worn, Contains("bob"));
    EXPECT_THAT(worn, Not(Contains("fringe")));
  }
  // Other kinds may cover the eyes.
  write_config("{fitted_to: head_0, items: [{name: fringe, kind: patch, file: fringe.obj}]}");
  for (const auto& worn : planned_attachments()) EXPECT_THAT(worn, Contains("fringe"));
}

}  // namespace
}  // namespace crowdface
