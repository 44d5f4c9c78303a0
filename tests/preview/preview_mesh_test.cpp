// SPDX-License-Identifier: Apache-2.0
#include "crowdface/preview/preview_mesh.h"

#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kColumns = 40, kRows = 30, kStride = kColumns + 1, kTear = 22;
constexpr std::uint32_t kVertices = kStride * (kRows + 1);

/// A flat sheet of unit quads, waved a little so that some edges are worth more; its texture is torn along a
/// column, where the right part lies five units higher.
Mesh torn_sheet() {
  Mesh sheet;
  sheet.topology.vertex_count = kVertices;
  sheet.positions.resize(kVertices, 3);
  sheet.uvs.resize(2 * kVertices, 2);
  for (std::uint32_t v = 0; v < kVertices; ++v) {
    const double x = v % kStride, y = v / kStride;
    sheet.positions.row(v) = Eigen::RowVector3d(x, y, 0.3 * std::sin(x / 3) * std::cos(y / 4));
    sheet.uvs.row(v) = Eigen::RowVector2d(x / 100, y / 100);
    sheet.uvs.row(v + kVertices) = Eigen::RowVector2d(x / 100, (y + 5) / 100);
  }
  for (std::uint32_t y = 0; y < kRows; ++y) {
    for (std::uint32_t x = 0; x < kColumns; ++x) {
      const std::uint32_t a = y * kStride + x;
      const std::array<std::uint32_t, 4> face = {a, a + 1, a + kStride + 1, a + kStride};
      std::array<std::uint32_t, 4> uvs = face;
      if (x >= kTear) {
        for (std::uint32_t& uv : uvs) uv += kVertices;
      }
      sheet.topology.add_face(face, uvs);
    }
  }
  return sheet;
}

/// How far right a triangle's corners lie, from the least to the most.
std::array<double, 2> width_of(const PreviewMesh& mesh, std::size_t triangle, const Mesh& sheet) {
  std::array<double, 2> width = {HUGE_VAL, -HUGE_VAL};
  for (std::size_t c = 0; c < 3; ++c) {
    const double x = sheet.positions(mesh.vertices[mesh.triangles[3 * triangle + c]], 0);
    width = {std::min(width[0], x), std::max(width[1], x)};
  }
  return width;
}

TEST(PreviewMesh, NoTriangleReachesAcrossATearOfTheTexture) {
  const Mesh sheet = torn_sheet();
  const PreviewMesh mesh = preview_mesh(sheet.topology, sheet.uvs, sheet.positions, {}, 150);
  EXPECT_LE(mesh.triangles.size() / 3, 330U);
  ASSERT_EQ(mesh.uvs.size(), 2 * mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size() / 3; ++t) {
    const auto [left, right] = width_of(mesh, t, sheet);
    EXPECT_TRUE(right <= kTear || left >= kTear) << left << " to " << right;
    const double raised = left >= kTear ? 5 : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[3 * t + c];
      const auto at = sheet.positions.row(mesh.vertices[v]);
      EXPECT_FLOAT_EQ(mesh.uvs[2 * v], static_cast<float>(at.x() / 100));
      EXPECT_FLOAT_EQ(mesh.uvs[2 * v + 1], static_cast<float>((at.y() + raised) / 100));
    }
  }
}

TEST(PreviewMesh, TwinsAreOneRowAndOnlyTheyAre) {
  const Mesh sheet = torn_sheet();
  const PreviewMesh mesh = preview_mesh(sheet.topology, sheet.uvs, sheet.positions, {}, 150);
  std::set<std::uint32_t> rows;
  std::size_t twins = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const bool is_new = rows.insert(mesh.vertices[v]).second;
    EXPECT_EQ(mesh.first_copy_of_vertex[v] == v, is_new);
    EXPECT_LE(mesh.first_copy_of_vertex[v], v);
    EXPECT_EQ(mesh.vertices[mesh.first_copy_of_vertex[v]], mesh.vertices[v]);
    if (is_new) continue;
    ++twins;
    EXPECT_EQ(sheet.positions(mesh.vertices[v], 0), kTear);
  }
  EXPECT_GE(twins, 2U) << "the ends of the tear at least";
}

TEST(PreviewMesh, LooksFollowOneAnotherAndKeepTheirBorder) {
  const Mesh sheet = torn_sheet();
  constexpr double kMiddle = 10;
  std::vector<std::uint32_t> looks;
  for (Index f = 0; f < sheet.topology.face_count(); ++f) {
    const double x = sheet.positions(sheet.topology.face(f)[0], 0);
    looks.push_back(x >= 30 ? kNoIndex : x >= kMiddle ? 7 : 3);
  }
  const SplitMesh split = split_mesh(sheet.topology, {}, looks);
  const PreviewMesh mesh = preview_from_split_mesh(split, split.triangles, {});
  EXPECT_TRUE(mesh.uvs.empty());
  EXPECT_EQ(mesh.material_starts, (std::vector<std::uint32_t>{0, 2 * kRows * 10}));
  EXPECT_EQ(mesh.triangles.size(), 3 * 2 * kRows * 30);
  for (std::size_t t = 0; t < mesh.triangles.size() / 3; ++t) {
    const auto [left, right] = width_of(mesh, t, sheet);
    EXPECT_EQ(left >= kMiddle, t >= mesh.material_starts[1]);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[3 * t + c];
      EXPECT_EQ(looks[mesh.face_of_vertex[v]], t >= mesh.material_starts[1] ? 7U : 3U);
      const auto face = sheet.topology.face(mesh.face_of_vertex[v]);
      EXPECT_NE(std::ranges::find(face, mesh.vertices[v]), face.end());
    }
  }
}

TEST(PreviewMesh, LeavesOutWhatIsNotDrawn) {
  const Mesh sheet = torn_sheet();
  std::vector<bool> drawn(kColumns * kRows);
  drawn[0] = true;
  const PreviewMesh mesh = preview_mesh(sheet.topology, sheet.uvs, sheet.positions, drawn, 150);
  EXPECT_EQ(mesh.triangles.size(), 6U);
  EXPECT_EQ(mesh.vertices.size(), 4U);
}

TEST(PreviewMesh, RefusesMarksOfOtherFaces) {
  const Mesh sheet = torn_sheet();
  EXPECT_THROW(preview_mesh(sheet.topology, sheet.uvs, sheet.positions, {true}, 150),
               BrokenPrecondition);
  EXPECT_TRUE(preview_mesh(sheet.topology, sheet.uvs, sheet.positions,
                           std::vector<bool>(kColumns * kRows), 150)
                  .triangles.empty());
}

TEST(PreviewMesh, DraftHasFewerTrianglesOverTheSameVerticesAndNoneAcrossATear) {
  const Mesh sheet = torn_sheet();
  const PreviewMesh mesh = preview_mesh(sheet.topology, sheet.uvs, sheet.positions, {}, 100'000);
  PreviewMesh draft = mesh;
  draft.triangles = draft_triangles(mesh, sheet.positions, 200);
  EXPECT_LE(draft.triangles.size() / 3, 200U);
  EXPECT_GE(draft.triangles.size() / 3, 50U);
  double area = 0;
  for (std::size_t t = 0; t < draft.triangles.size() / 3; ++t) {
    const auto [left, right] = width_of(draft, t, sheet);
    EXPECT_FALSE(left < kTear && right > kTear);
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = sheet.positions.row(draft.vertices[draft.triangles[3 * t + c]]).transpose();
    }
    area += (corners[1] - corners[0]).cross(corners[2] - corners[0]).z() / 2;
  }
  EXPECT_NEAR(area, kColumns * kRows, 1e-6);  // nothing is left out
}

}  // namespace
}  // namespace crowdface
