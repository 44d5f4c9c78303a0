// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/face_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/io/obj_file.h"

#include "paint/changed_heads.h"
#include "paint/synth_heads.h"
#include "support/meshes.h"

namespace crowdface::testing {
namespace {

/// Of synthetic heads the eyes' middle is the origin, and the lips meet some 7 cm below.
TEST(FaceMarks, LieWhereASyntheticHeadHasThemAtAnyResolution) {
  for (const Index vertices : {5000, 20000}) {
    const HeadSet faces = synth_heads(vertices);
    HeadShape head = mean_head_shape(faces);
    EXPECT_EQ(head.eyeball_centres.size(), 2U);
    const auto marks = find_face_marks(faces.topology, head, {});
    ASSERT_TRUE(marks);
    EXPECT_NEAR(marks->symmetry_offset, 0, 0.2);
    EXPECT_NEAR(marks->eyes_height, 0, 0.3);
    EXPECT_NEAR(marks->mouth_height, -7, 0.4);
    EXPECT_GT(marks->bridge_height, marks->tip_height + 2);
    EXPECT_GT(marks->tip_height, marks->mouth_height + 2);
    EXPECT_NEAR(marks->chin_height, -11.3, 1);
    head.eyeball_centres.clear();
    EXPECT_NEAR(find_face_marks(faces.topology, head, {})->eyes_height, 0, 0.6)
        << "told by the nose";
  }
}

/// Replaces all vertices in each cell of a grid by their mean.
HeadShape merged(Topology& topology, const HeadShape& head, double cell) {
  std::map<std::array<long, 3>, std::uint32_t> cells;
  std::vector<std::uint32_t> row;
  for (Index v = 0; v < head.positions.rows(); ++v) {
    const Eigen::Array3d p = (head.positions.row(v) / cell).array().floor();
    row.push_back(cells
                      .try_emplace({std::lround(p.x()), std::lround(p.y()), std::lround(p.z())},
                                   static_cast<std::uint32_t>(cells.size()))
                      .first->second);
  }
  HeadShape result{
      Positions::Zero(std::ssize(cells), 3), std::vector<bool>(cells.size(), true), {}};
  std::vector<double> counts(cells.size(), 0);
  for (std::size_t v = 0; v < row.size(); ++v) {
    result.positions.row(row[v]) += head.positions.row(static_cast<Index>(v));
    ++counts[row[v]];
  }
  for (std::size_t r = 0; r < counts.size(); ++r) {
    result.positions.row(static_cast<Index>(r)) /= counts[r];
  }
  Topology coarse;
  for (Index f = 0; f < topology.face_count(); ++f) {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t v : topology.face(f)) {
      if (head.is_skin[v] && std::ranges::find(corners, row[v]) == corners.end())
        corners.push_back(row[v]);
    }
    if (corners.size() < 3) continue;
    coarse.corner_vertices.insert(coarse.corner_vertices.end(), corners.begin(), corners.end());
    coarse.face_offsets.push_back(static_cast<std::uint32_t>(coarse.corner_vertices.size()));
  }
  coarse.vertex_count = std::ssize(cells);
  topology = coarse;
  return result;
}

// The message said that the heads look along +Z although expected along +Z.
TEST(FaceMarks, AReasonIsGivenIfNoFaceIsFound) {
  const HeadSet faces = synth_heads(5000);
  const HeadShape head = mean_head_shape(faces);
  EXPECT_EQ(why_no_face_found(faces.topology, head, axes_of({{1, 1}, {0, 1}})),
            "the heads look along +Z with +Y up");
  Topology topology = faces.topology;
  const HeadShape coarse = merged(topology, head, 2.6);
  ASSERT_FALSE(find_face_marks(topology, coarse, {}));
  const std::string reason = why_no_face_found(topology, coarse, {});
  EXPECT_NE(reason.find("mm long; above 18 mm they do not show a face"), reason.npos) << reason;
}

TEST(FaceMarks, AHeadIsFoundHoweverItIsTurned) {
  HeadSet faces = synth_heads(5000);
  HeadShape head = mean_head_shape(faces);
  const Positions upright = head.positions;
  for (int up = 0; up < 3; ++up) {
    for (int front = 0; front < 3; ++front) {
      if (front == up) continue;
      for (const int sign : {1, -1}) {
        const Orientation orientation{{up, sign}, {front, -sign}};
        const HeadAxes axes = axes_of(orientation);
        for (Index v = 0; v < upright.rows(); ++v) {
          head.positions.row(v) =
              (upright(v, 0) * axes.side() + upright(v, 1) * axes.up + upright(v, 2) * axes.front)
                  .transpose();
        }
        EXPECT_EQ(find_orientation(faces.topology, head), orientation);
        const HeadAxes wrong{axes.up, axes.front};
        EXPECT_FALSE(find_face_marks(faces.topology, head, wrong));
      }
    }
  }
}

TEST(FaceMarks, AreTheSameHoweverTheMeshIsCutOrTurned) {
  const HeadSet faces = synth_heads(20000);
  HeadShape head = mean_head_shape(faces);
  head.positions = faces.heads[1].positions;
  const std::vector<MarkError> errors = mark_errors(faces.topology, head);
  EXPECT_FALSE(errors.empty());
  for (const MarkError& error : errors) {
    EXPECT_TRUE(error.is_found) << error.change;
    // Few vertices do not show where the lips meet.
    const bool is_coarse = error.change == "thinned to a twentieth" && error.mark == "mouth";
    EXPECT_LT(error.mm, is_coarse ? 4 : 3) << error.mark << ", " << error.change;
  }
}

// The height of the eyes followed the fitted relief, whose height, size and stretch are uncertain,
// and was off by 4 to 5 mm.
TEST(FaceMarks, HollowsShowTheEyesOfAnUnusualFace) {
  const HeadSet faces = synth_heads(20000);
  constexpr double kSpreadCm = 2.5;
  for (const double raised_cm : {-1.5, 1.2}) {
    HeadShape head = mean_head_shape(faces);
    head.eyeball_centres.clear();
    for (Index v = 0; v < head.positions.rows(); ++v) {
      double& height = head.positions(v, 1);
      height += raised_cm * std::exp(-height * height / (kSpreadCm * kSpreadCm));
    }
    const auto marks = find_face_marks(faces.topology, head, {});
    ASSERT_TRUE(marks);
    EXPECT_NEAR(marks->eyes_height, raised_cm, 0.3);
  }
}

/// Heads that are not kept in this repository.
TEST(RealFaces, AreTheSameHoweverTheMeshIsCutOrTurned) {
  const std::filesystem::path heads =
      std::filesystem::path(CROWDFACE_SOURCE_DIR) / "../shared/faces/ict16";
  if (!std::filesystem::is_directory(heads)) {
    GTEST_SKIP() << "no real heads at " << heads << ": put OBJ files there";
  }
  std::size_t marks = 0, far = 0;
  for (const auto& entry : std::filesystem::directory_iterator(heads)) {
    if (entry.path().extension() != ".obj") continue;
    SCOPED_TRACE(entry.path().filename());
    ObjFile file = read_obj(entry.path());
    const HeadSet faces{file.topology, {}, {{"head", file.positions}}};
    HeadShape head = mean_head_shape(faces);
    EXPECT_EQ(find_orientation(faces.topology, head), (Orientation{{1, 1}, {2, 1}}));
    EXPECT_TRUE(put_at_origin(faces.topology, head));
    for (const MarkError& error : mark_errors(faces.topology, head)) {
      // The edges of a thinned head may be too long to show a face.
      EXPECT_TRUE(error.is_found || error.change == "thinned to a twentieth") << error.change;
      ++marks;
      if (error.mm > 3) ++far;
    }
  }
  EXPECT_LT(far, marks / 50) << "more than 3 mm off, of " << marks;
}

TEST(FaceMarks, WhatIsNoHeadHasNoFace) {
  HeadShape cube{cube_positions(), std::vector<bool>(8, true), {}};
  EXPECT_FALSE(find_face_marks(cube_topology(), cube, {}));
  EXPECT_FALSE(find_orientation(cube_topology(), cube));
  cube.is_skin.assign(8, false);
  EXPECT_FALSE(find_orientation(cube_topology(), cube));
  cube.is_skin.assign(8, true);
  cube.positions.setZero();
  EXPECT_FALSE(find_orientation(cube_topology(), cube));
}

}  // namespace
}  // namespace crowdface::testing
