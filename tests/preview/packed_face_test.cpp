// SPDX-License-Identifier: Apache-2.0
#include "crowdface/preview/packed_face.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "crowdface/core/require.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/preview/reduced_mesh.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

/// A ball of quads, its poles left open.
struct Ball {
  static constexpr std::uint32_t kAround = 24, kUp = 12;
  Topology topology;
  Positions positions{kAround * (kUp + 1), 3};

  Ball() {
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t j = 0; j <= kUp; ++j) {
      const double polar = std::numbers::pi * (j + 1) / (kUp + 2);
      for (std::uint32_t i = 0; i < kAround; ++i) {
        const double turn = 2 * std::numbers::pi * i / kAround;
        positions.row(j * kAround + i) = Eigen::RowVector3d(
            std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
        const std::uint32_t next = (i + 1) % kAround;
        if (j < kUp) {
          faces.push_back({j * kAround + i, j * kAround + next, (j + 1) * kAround + next,
                           (j + 1) * kAround + i});
        }
      }
    }
    topology = testing::make_topology(positions.rows(), faces);
  }
};

double number_at(const std::string& bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[2 * i]) +
         256 * static_cast<unsigned char>(bytes[2 * i + 1]);
}

/// What the gallery's page does with the two numbers of a normal.
Eigen::Vector3d folded(double u, double v) {
  double x = u / 65535 * 2 - 1;
  double y = v / 65535 * 2 - 1;
  const double z = 1 - std::abs(x) - std::abs(y);
  if (z < 0) {
    const double kept = x;
    x = (1 - std::abs(y)) * (kept < 0 ? -1 : 1);
    y = (1 - std::abs(kept)) * (y < 0 ? -1 : 1);
  }
  return Eigen::Vector3d(x, y, z).normalized();
}

TEST(PackedFace, ComesBackWithinHalfAStepAndAHundredthOfADegree) {
  const Ball ball;
  const ReducedMesh mesh = reduce_mesh(triangles_of(ball.topology), ball.positions, 1000);
  const std::array heads = {&ball.positions};
  const PackingGrid frame = PackingGrid::enclosing(heads);
  const std::string bytes =
      pack_face(ball.topology, mesh.vertices, VertexFaces(ball.topology), frame, ball.positions);
  const std::size_t count = mesh.vertices.size();
  ASSERT_EQ(bytes.size(), 10 * count);
  const Positions normals = vertex_normals(ball.topology, ball.positions);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t vertex = mesh.vertices[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Index>(axis);
      EXPECT_NEAR(frame.low_corner[a] + frame.step * number_at(bytes, 3 * i + axis),
                  ball.positions(vertex, a), 0.501 * frame.step);
    }
    const Eigen::Vector3d normal =
        folded(number_at(bytes, 3 * count + 2 * i), number_at(bytes, 3 * count + 2 * i + 1));
    EXPECT_GT(normal.dot(normals.row(vertex).transpose()), 1 - 1.5e-8);
  }
}

TEST(PackedFace, FrameLeavesAQuarterAroundTheHeads) {
  Positions head(2, 3);
  head << 0, 0, 0, 8, 2, 4;
  const std::array heads = {static_cast<const Positions*>(&head)};
  const PackingGrid frame = PackingGrid::enclosing(heads);
  EXPECT_DOUBLE_EQ(frame.low_corner.x(), -2);
  EXPECT_DOUBLE_EQ(frame.low_corner.y(), -5);
  EXPECT_DOUBLE_EQ(frame.low_corner.x() + 65535 * frame.step, 10);
  EXPECT_THROW(PackingGrid::enclosing({}), BrokenPrecondition);
}

TEST(PackedFace, WhatLiesBeyondTheFrameIsMovedToItsRim) {
  const Ball ball;
  const ReducedMesh mesh = reduce_mesh(triangles_of(ball.topology), ball.positions, 1000);
  const PackingGrid frame{Eigen::Vector3d::Constant(5), 1e-6};
  const std::string bytes =
      pack_face(ball.topology, mesh.vertices, VertexFaces(ball.topology), frame, ball.positions);
  for (std::size_t i = 0; i < 3 * mesh.vertices.size(); ++i) EXPECT_EQ(number_at(bytes, i), 0);
}

TEST(PackedFace, RefusesAnotherNumberOfVertices) {
  const Ball ball;
  const ReducedMesh mesh = reduce_mesh(triangles_of(ball.topology), ball.positions, 1000);
  EXPECT_THROW(pack_face(ball.topology, mesh.vertices, VertexFaces(ball.topology), {},
                         ball.positions.topRows(5)),
               BrokenPrecondition);
}

TEST(Base64, GivesTheExamplesOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace crowdface
