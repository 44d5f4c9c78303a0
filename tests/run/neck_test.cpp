// SPDX-License-Identifier: Apache-2.0
// Whole runs of crowds whose faces all end on one body.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/cast/compared_area.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"

#include "neck_crowd.h"
#include "support/crowd_files.h"
#include "support/mesh_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::expect_seam;
using testing::kAllWithLevels;
using testing::kThreeRecipes;
using testing::kVaried;
using testing::Single;
using testing::Singles;
using testing::Surface;
using testing::usd_rows;

using Neck = testing::NeckCrowd;

TEST_F(Neck, EveryFileOfEveryFaceEndsInTheBodysRing) {
  for (const char* boundary : {"fixed", "free"}) {
    const auto out =
        run("{body: body.obj}", concat("smoothing: {boundary: ", boundary, "}\n", kVaried),
            kAllWithLevels, boundary);
    const Job job = load_job(folder_ / concat(boundary, ".yaml"), {});
    const Singles normals = normals_at_seam(job.inputs);
    std::map<Single, Single> found;
    std::size_t files = 0, mirrored = 0;
    for (const auto& line : testing::plan_lines(out)) mirrored += line.contains("mirrored");
    for (const auto& entry : fs::directory_iterator(out / "meshes")) {
      if (!entry.is_regular_file()) continue;
      expect_seam(entry.path(), seam_, normals, found);
      ++files;
    }
    EXPECT_EQ(files, 6 * (5 + 2 * 4)) << "six faces in five formats, levels of detail in four";
    EXPECT_GT(mirrored, 0U);
    EXPECT_TRUE(verify_crowd(out).is_intact());
  }
}

// The body changes neither the plan nor the faces above the bend.
TEST_F(Neck, TheCrowdIsTheSame) {
  const std::string more = concat(kThreeRecipes, kVaried);
  const auto plain = run("", more, "", "plain"), fitted = run("{body: body.obj}", more);
  const Job job = load_job(folder_ / "out.yaml", {});
  std::vector<double> areas =
      compared_vertex_areas(job.inputs.head_set.topology, job.inputs.skin_components,
                            job.inputs.mean_head, ComparedArea::kFront, {2, 1});
  for (const std::uint32_t v : job.inputs.heads_on_body->seam.neck_bend.vertices()) areas[v] = 0;
  for (const std::uint32_t v : rim_) areas[v] = 0;
  const auto before = testing::plan_lines(plain), after = testing::plan_lines(fitted);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].at("regions"), after[i].at("regions"));
    const auto mesh_of = [&](const fs::path& crowd) {
      return read_obj(crowd / "meshes" / concat(before[i].at("id").get<std::string>(), ".obj"))
          .positions;
    };
    EXPECT_LT(face_distance(mesh_of(plain), mesh_of(fitted), areas), 1e-4) << before[i].at("id");
  }
  const auto faces = [](const fs::path& crowd) {
    return testing::read_json(crowd / "report.json").at("faces");
  };
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto skin = faces(plain).at(i).at("skin"), bent = faces(fitted).at(i).at("skin");
    EXPECT_EQ(skin.at("flipped"), bent.at("flipped"));
    EXPECT_NEAR(bent.at("stretch").get<double>(), skin.at("stretch").get<double>(), 0.01);
    EXPECT_NEAR(bent.at("wider_mm").get<double>(), skin.at("wider_mm").get<double>(), 0.01);
  }
}

// A finished crowd gets a body, another falloff and no body again; its faces stay who they are.
TEST_F(Neck, MayChangeInAFinishedCrowd) {
  const auto files = [&](const std::string& name) { return testing::crowd_files(folder_ / name); };
  const std::string more = concat(kVaried, "traits: {face_height: {}}\n");
  run("", more);
  const auto plain = files("out");
  const auto before = testing::plan_lines(folder_ / "out");
  for (const char* neck : {"{body: body.obj}", "{body: body.obj, falloff: 40 mm}", "mean"}) {
    SCOPED_TRACE(neck);
    run(neck, more);
    const auto lines = testing::plan_lines(folder_ / "out");
    ASSERT_EQ(lines.size(), before.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      auto line = lines[i];
      line["traits"] = before[i].at("traits");
      for (const char* distance : {"face_mm", "crowd_mm"}) {
        auto& mm = line["nearest"][distance];
        const auto& mm_before = before[i].at("nearest").at(distance);
        if (!mm.is_number() || !mm_before.is_number()) continue;
        EXPECT_NEAR(mm.get<double>(), mm_before.get<double>(), 1.5e-4);  // rounded
        mm = mm_before;
      }
      EXPECT_EQ(line, before[i]);
    }
    EXPECT_NE(files("out").at("meshes/mob_0001.obj"), plain.at("meshes/mob_0001.obj"));
    fs::remove_all(folder_ / "again");
    run(neck, more, "", "again");
    EXPECT_THAT(testing::differing_files(files("again"), files("out")), ::testing::IsEmpty());
  }
  run("", more);
  EXPECT_THAT(testing::differing_files(plain, files("out")), ::testing::IsEmpty());
}

/// The difference of each vertex from the mean of its neighbours; zero on open borders.
Positions curvature(const Inputs& inputs, const Positions& positions) {
  Positions result = Positions::Zero(positions.rows(), 3);
  for (Index v = 0; v < positions.rows(); ++v) {
    const auto around = inputs.adjacency.items_of(v);
    if (inputs.adjacency.boundary[static_cast<std::size_t>(v)] || around.empty()) continue;
    for (const std::uint32_t other : around) result.row(v) += positions.row(other);
    result.row(v) = result.row(v) / static_cast<double>(around.size()) - positions.row(v);
  }
  return result;
}

/// Returns how much a bend changes the curvature at its upper end: the rms change in the last moved
/// and the first fixed row of vertices, divided by the head's own rms curvature in the bend.
double change_at_end(const Inputs& inputs, const Positions& head, const Positions& bent) {
  const Positions before = curvature(inputs, head), after = curvature(inputs, bent);
  std::vector<bool> moves(static_cast<std::size_t>(head.rows()), false);
  for (const std::uint32_t v : inputs.heads_on_body->seam.neck_bend.vertices()) moves[v] = true;
  for (const std::uint32_t v : inputs.heads_on_body->seam.rim) moves[v] = true;
  double change = 0, own = 0, at_end = 0, all = 0;
  for (Index v = 0; v < head.rows(); ++v) {
    const auto around = inputs.adjacency.items_of(v);
    const auto moving = std::ranges::count_if(around, [&](std::uint32_t u) { return moves[u]; });
    if (inputs.adjacency.boundary[static_cast<std::size_t>(v)] || moving == 0) continue;
    own += before.row(v).squaredNorm();
    ++all;
    if (moving == std::ssize(around)) continue;
    change += (after.row(v) - before.row(v)).squaredNorm();
    ++at_end;
  }
  return std::sqrt(change / at_end / (own / all));
}

// The bend ends without a visible step: the curvature that it adds there is small compared with the
// heads' own. A displacement that fades linearly has a crease there.
TEST_F(Neck, TheBendIsSmootherThanTheHeads) {
  const Job job = load_job(configure("{body: body.obj}", ""), {});
  const Inputs& inputs = job.inputs;
  constexpr double kFalloff = 6, kVisible = 0.16;
  EdgeDistances distances(inputs.adjacency, inputs.mean_head);
  distances.search(rim_, kFalloff);
  double smooth = 0, linear = 0;
  for (const Head& head : inputs.head_set.heads) {
    Positions bent = head.positions, creased = head.positions;
    inputs.heads_on_body->seam.bend_to_seam(bent);
    smooth += change_at_end(inputs, head.positions, bent) / kHeads;
    for (const std::uint32_t v : distances.reached()) {
      const std::uint32_t from = rim_[distances.nearest_source(v)];
      creased.row(v) +=
          (1 - distances.distance(v) / kFalloff) * (bent.row(from) - head.positions.row(from));
    }
    linear += change_at_end(inputs, head.positions, creased) / kHeads;
  }
  EXPECT_LT(smooth, 0.7 * kVisible);
  EXPECT_GT(linear, 1.2 * kVisible);
}

TEST_F(Neck, ShapesDoNotMoveTheRing) {
  Positions shrug = read_obj(folder_ / "heads/head_0.obj").positions;
  for (Index v = 0; v < shrug.rows(); ++v) shrug(v, 1) += 0.5 - 0.02 * shrug(v, 1);
  encode_obj({heads_.topology(), shrug, heads_.uvs()}, "")
      .write(folder_.write("shapes/a", "").parent_path() / "shrug.obj");
  const auto out =
      run("{body: body.obj}", "shapes: {neutral: heads/head_0.obj, directory: shapes}\n",
          ", meshes: [obj, glb, usd]");
  const Job job = load_job(folder_ / "out.yaml", {});
  const std::vector<std::uint32_t>& moved = job.inputs.shapes.shapes[0].moves.vertices;
  EXPECT_GT(moved.size(), 5000U);
  for (const std::uint32_t v : rim_) EXPECT_FALSE(std::ranges::binary_search(moved, v));
  const Singles normals = normals_at_seam(job.inputs);
  std::map<Single, Single> found;
  for (int face = 1; face <= 4; ++face) {
    expect_seam(out / "meshes" / concat("mob_000", face, "+shrug.obj"), seam_, normals, found);
  }
}

/// The points and normals of the mesh `body` in a GLB or USD file; empty if there is none.
Surface body_in(const fs::path& file) {
  if (file.extension() == ".glb") {
    const testing::GlbFile glb = testing::read_glb(file, 1);
    EXPECT_EQ(glb.scene.at("meshes").at(1).at("name"), "body");
    return {glb.points, glb.normals};
  }
  const std::string layer = testing::read_text(file);
  const std::size_t begin = layer.find("def Mesh \"body\"");
  if (begin == layer.npos) return {};
  const std::string mesh = layer.substr(begin);
  return {usd_rows(mesh, "point3f[] points = ["), usd_rows(mesh, "normal3f[] normals = [")};
}

TEST_F(Neck, GlbAndUsdFilesContainTheBody) {
  const auto out =
      run("{body: body.obj, write_body: true}", "", ", meshes: [obj, ply, glb, usd], lods: [40 %]");
  const Job job = load_job(folder_ / "out.yaml", {});
  const Singles normals = normals_at_seam(job.inputs);
  std::map<Single, Single> found;
  for (const char* file :
       {"mob_0001.glb", "mob_0002.usda", "mob_0003+LOD1.glb", "mob_0004+LOD1.usda"}) {
    expect_seam(out / "meshes" / file, seam_, normals, found);
    // The body has the normals of the faces, not those of its own polygons alone.
    expect_seam(body_in(out / "meshes" / file), file, seam_, normals, found);
  }
  for (const char* file : {"mob_0001.obj", "mob_0001.ply", "mob_0001+LOD1.obj"}) {
    EXPECT_EQ(testing::read_text(out / "meshes" / file).find("body"), std::string::npos) << file;
  }
  EXPECT_EQ(body_in(out / "meshes/mob_0001.glb").points.size(),
            static_cast<std::size_t>(body_.positions.rows()));
  EXPECT_LT(body_in(out / "meshes/mob_0001+LOD1.glb").points.size(),
            static_cast<std::size_t>(body_.positions.rows()));
  EXPECT_TRUE(verify_crowd(out).is_intact());
  // Faces are those of a crowd without the body.
  const auto plain = run("{body: body.obj}", "", ", meshes: [obj]", "plain");
  EXPECT_EQ(testing::read_text(out / "meshes/mob_0004.obj"),
            testing::read_text(plain / "meshes/mob_0004.obj"));
}

}  // namespace
}  // namespace crowdface
