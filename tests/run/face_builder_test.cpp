// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_builder.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "crowdface/blend/blend.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/head_mirror.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/run/job.h"
#include "crowdface/run/mesh_judge.h"
#include "head_models/synth/synthetic_head.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

constexpr Index kHeads = 4;

/// A folder of synthetic heads and a config for them.
struct Folder {
  explicit Folder(const std::string& contacts) {
    const SyntheticHeads synthetic(5000, SyntheticHeads::Parts::kSkin);
    std::filesystem::create_directories(folder / "heads");
    for (Index h = 0; h < kHeads; ++h) {
      Mesh mesh{synthetic.topology(), synthetic.positions(3, static_cast<std::uint64_t>(h)),
                synthetic.uvs()};
      encode_obj(mesh, "").write(folder / concat("heads/head_", h, ".obj"));
    }
    folder.write("config.yaml", concat("schema: 1\n"
                                       "crowd: {name: face, count: 1}\n"
                                       "faces: {directory: heads, units: cm}\n"
                                       "smoothing: {levels: exact}\n"
                                       "blending: {contacts: ",
                                       contacts, "}\noutput: {directory: out}\n"));
    job.emplace(load_job(folder / "config.yaml", {}));
    prepared.emplace(prepare(job->config, job->inputs, job->smoothing, folder / "cache"));
  }
  Positions build(const Recipe& recipe) const {
    return FaceBuilder(job->config, job->inputs, *prepared).build(recipe);
  }
  testing::TemporaryFolder folder;
  std::optional<Job> job;
  std::optional<PreparedHeads> prepared;
};

Recipe recipe(Index target, Index source, std::uint64_t iterations, double extrapolation) {
  return {target, {{std::nullopt, {{source, 1.0}}, 0, iterations, extrapolation, {}}}};
}

TEST(FaceBuilder, KeepsLipsBetweenTheTargetsAndTheSourcesGap) {
  const Folder with("auto"), without("none");
  const Inputs& inputs = with.job->inputs;
  std::vector<std::uint32_t> skin(static_cast<std::size_t>(inputs.head_set.topology.vertex_count));
  for (std::uint32_t v = 0; v < skin.size(); ++v) skin[v] = v;
  const SkinContacts contacts(inputs.head_set, inputs.adjacency, skin);
  ASSERT_GT(contacts.size(), 0U);
  // How far the gaps of a face are outside those of its two heads.
  const auto outside = [&](const Positions& face, Index target, Index source) {
    const std::vector<double> gaps = contacts.gaps(face);
    double most = 0;
    for (std::size_t p = 0; p < gaps.size(); ++p) {
      const auto [least, widest] =
          std::minmax(contacts.head_gaps(target)[p], contacts.head_gaps(source)[p]);
      most = std::max({most, least - gaps[p], gaps[p] - widest});
    }
    return most;
  };
  double before = 0;
  for (Index target = 0; target < kHeads; ++target) {
    const Index source = (target + 1) % kHeads;
    const Recipe one = recipe(target, source, 60, 1.3);
    before = std::max(before, outside(without.build(one), target, source));
    EXPECT_LT(outside(with.build(one), target, source), 0.01) << target << ": a tenth of a mm";
  }
  EXPECT_GT(before, 0.05) << "something to correct";
}

TEST(FaceBuilder, FollowsTheEquationsToTheBitWithoutContacts) {
  const Folder folder("none");
  const Recipe one = recipe(0, 1, 60, 1.3);
  EXPECT_TRUE(folder.build(one) == blend_exact(folder.job->inputs.head_set,
                                               *folder.prepared->filter, folder.job->inputs.regions,
                                               one));
}

// Lips are brought to their gaps before a face is mirrored.
TEST(FaceBuilder, GivesAMirroredFaceTheContactsOfItsTwin) {
  const Folder with("auto"), without("none");
  const Job& job = *with.job;
  const FaceBuilder builder(job.config, job.inputs, *with.prepared);
  const MeshDefectFinder find_mesh_defects = mesh_defect_finder(job.config, job.inputs, builder);
  const auto mirror = required_mirror_map(job.config, job.inputs, "a test");
  for (const double asymmetry : {1.0, 1.5}) {
    Recipe plain = recipe(0, 1, 60, 1.3);
    plain.asymmetry = asymmetry;
    Recipe image = plain;
    image.mirrored = true;
    const Positions face = with.build(plain);
    EXPECT_GT((face - without.build(plain)).cwiseAbs().maxCoeff(), 0.02) << "something to correct";
    EXPECT_TRUE(mirrored(*mirror, face) == with.build(image));
    const SkinDefects of_plain = find_mesh_defects(plain), of_image = find_mesh_defects(image);
    constexpr double kRounding = 1e-6;
    EXPECT_NEAR(of_plain.gap_excess_mm, of_image.gap_excess_mm, kRounding);
    EXPECT_NEAR(of_plain.local.stretch_factor, of_image.local.stretch_factor, kRounding);
    EXPECT_EQ(of_plain.intersecting_triangle_count, of_image.intersecting_triangle_count);
    EXPECT_NEAR(of_plain.exposed_back_face_mm2, of_image.exposed_back_face_mm2, kRounding);
  }
}

TEST(FaceBuilder, LeavesATargetBlendedWithItselfAsItIs) {
  const Folder folder("auto");
  EXPECT_TRUE(folder.build(recipe(2, 2, 60, 1)) == folder.job->inputs.head_set.heads[2].positions);
}

}  // namespace
}  // namespace crowdface
