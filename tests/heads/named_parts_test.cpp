// SPDX-License-Identifier: Apache-2.0
// Parts in a whole job: what follows, what stays as it was, what is refused.
#include "crowdface/heads/named_parts.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/job.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

using ::testing::HasSubstr;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

SmallCrowd crowd_with(const std::string& parts, const std::string& levels = "exact") {
  SmallCrowd crowd;
  crowd.parts = parts;
  crowd.levels = levels;
  crowd.regions = 3;
  return crowd;
}

/// The first face of the crowd made there.
std::string face_in(const SmallCrowdFolder& folder, const std::string& out) {
  run_to(folder, out);
  return testing::read_text(folder / (out + "/meshes/mob_0001.obj"));
}

double distance(const reference::Obj& mesh, std::size_t a, std::size_t b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    sum +=
        (mesh.vertices[a][c] - mesh.vertices[b][c]) * (mesh.vertices[a][c] - mesh.vertices[b][c]);
  }
  return std::sqrt(sum);
}

TEST(PartsOfAJob, LeaveTheSkinAndMoveAnEyeAsAWhole) {
  SmallCrowdFolder folder(crowd_with("none"));
  run_to(folder, "none");
  folder.configure(crowd_with("auto"));
  run_to(folder, "auto");
  const auto lines = testing::plan_lines(folder / "auto");
  ASSERT_EQ(lines.size(), 4U);
  bool moved = false;
  for (const auto& line : lines) {
    const std::string name = concat("meshes/", line.at("id").get<std::string>(), ".obj");
    const auto plain = reference::read_obj(folder / ("none/" + name));
    const auto followed = reference::read_obj(folder / ("auto/" + name));
    const auto target = reference::read_obj(folder.head(line.at("target").get<std::string>()));
    const std::size_t skin = plain.vertices.size() - 9;  // a cube for an eye, and a stray vertex
    for (std::size_t v = 0; v < skin; ++v) EXPECT_EQ(plain.vertices[v], followed.vertices[v]);
    EXPECT_EQ(plain.vertices.back(), followed.vertices.back());
    const double scale = distance(followed, skin, skin + 1) / distance(target, skin, skin + 1);
    for (std::size_t v = skin + 1; v < skin + 8; ++v) {
      EXPECT_NEAR(distance(followed, skin, v), scale * distance(target, skin, v), 1e-5);
      moved = moved || plain.vertices[v] != followed.vertices[v];
    }
  }
  EXPECT_TRUE(moved);
}

TEST(PartsOfAJob, HaveTheSameBytesOnAnyThreadsAndAlone) {
  for (const char* levels : {"exact", "basis"}) {
    const SmallCrowdFolder folder(crowd_with("auto", levels));
    const std::string many = face_in(folder, "many");
    {
      const ThreadLimit limit(1);
      EXPECT_EQ(face_in(folder, "one"), many) << levels;
    }
    const Job job = load_job(folder.config(), {});
    const PreparedHeads prepared = prepare(job.config, job.inputs, job.smoothing, folder.cache());
    const FaceBuilder builder(job.config, job.inputs, prepared);
    const auto plan = read_plan(folder / "many/plan.jsonl", job.names);
    std::vector<const Recipe*> recipes;
    for (const PlanLine& line : plan) recipes.push_back(&line.face.recipe);
    std::vector<Positions> together(recipes.size());
    builder.build(recipes, together);
    for (std::size_t f = 0; f < recipes.size(); ++f) {
      Positions alone;
      builder.build(std::span(&recipes[f], 1), std::span(&alone, 1));
      EXPECT_TRUE(alone == together[f]) << levels;
    }
  }
}

TEST(PartsOfAJob, EnterTheSettingsOnlyIfThereAreAny) {
  SmallCrowdFolder folder(crowd_with("none"));
  const auto settings = [&](const std::string& parts) {
    folder.configure(crowd_with(parts));
    return load_job(folder.config(), {}).settings.hex();
  };
  const std::string none = settings("none");
  EXPECT_NE(settings("auto"), none);
  EXPECT_NE(settings("{shape: blend}"), settings("auto"));
  EXPECT_EQ(settings("{skin: [eye]}"), none) << "all is skin: as if nothing followed";
}

TEST(PartsOfAJob, AreDescribed) {
  SmallCrowdFolder folder(crowd_with("auto"));
  Job job = load_job(folder.config(), {});
  const std::string text = describe_parts(job.config, job.inputs);
  EXPECT_THAT(text, HasSubstr("skin: components 1 … 3 (2)"));
  EXPECT_THAT(text, HasSubstr("rigid: component 2, 8 vertices, eye"));
  job.config.parts.follow_skin = false;
  EXPECT_THAT(describe_parts(job.config, job.inputs), HasSubstr("none"));
}

TEST(PartsOfAJob, AreRefusedUnderNamesThatNothingBears) {
  SmallCrowdFolder folder(crowd_with("{rigid: [eyes], bound: [component 9]}"));
  testing::expect_error(ExitCode::kUsage,
                        {"parts.rigid: expected the material or group of a component",
                         "found \"eyes\"; did you mean \"eye\"?", "found \"component 9\""},
                        [&] { load_job(folder.config(), {}); });
  folder.configure(crowd_with("{rigid: [eye], bound: [component 2]}"));
  testing::expect_error(ExitCode::kUsage, {"another list also names"},
                        [&] { load_job(folder.config(), {}); });
  folder.configure(crowd_with("{rigid: [component 1]}"));
  testing::expect_error(ExitCode::kUsage, {"the largest component"},
                        [&] { load_job(folder.config(), {}); });
}

}  // namespace
}  // namespace crowdface
