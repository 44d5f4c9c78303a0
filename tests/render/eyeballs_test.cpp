// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/eyeballs.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "render/shapes.h"

namespace crowdface {
namespace {

/// Two spheres in one mesh, the second of radius 2 around (10, 0, 0).
Mesh two_balls() {
  Mesh mesh = make_sphere(1, 8, 12);
  const Mesh second = make_sphere(2, 8, 12);
  const auto shift = static_cast<std::uint32_t>(mesh.topology.vertex_count);
  const std::uint32_t corners = mesh.topology.face_offsets.back();
  for (const std::uint32_t v : second.topology.corner_vertices) {
    mesh.topology.corner_vertices.push_back(v + shift);
  }
  for (std::size_t f = 1; f < second.topology.face_offsets.size(); ++f) {
    mesh.topology.face_offsets.push_back(second.topology.face_offsets[f] + corners);
  }
  mesh.topology.vertex_count *= 2;
  Positions both(mesh.topology.vertex_count, 3);
  both << mesh.positions, second.positions.rowwise() + Eigen::RowVector3d(10, 0, 0);
  mesh.positions = both;
  return mesh;
}

TEST(Eyeballs, EachConnectedPartIsOne) {
  const Mesh mesh = two_balls();
  const std::vector<SurfaceKind> kinds(static_cast<std::size_t>(mesh.topology.face_count()),
                                       SurfaceKind::kEye);
  const Eyeballs eyeballs = find_eyeballs(mesh.topology, kinds);
  ASSERT_EQ(eyeballs.count, 2U);
  std::vector<float> points(mesh.positions.data(), mesh.positions.data() + mesh.positions.size());
  const auto eyes = place_eyes(eyeballs, points, Eigen::Vector3f::UnitZ());
  EXPECT_TRUE(eyes[0].centre.isZero(1e-5F));
  EXPECT_NEAR(eyes[0].radius, 1, 1e-5);
  EXPECT_TRUE(eyes[1].centre.isApprox(Eigen::Vector3f(10, 0, 0), 1e-5F));
  EXPECT_NEAR(eyes[1].radius, 2, 1e-5);
}

TEST(Eyeballs, SkinIsNone) {
  const Mesh mesh = two_balls();
  std::vector<SurfaceKind> kinds(static_cast<std::size_t>(mesh.topology.face_count()));
  EXPECT_EQ(find_eyeballs(mesh.topology, kinds).count, 0U);
  EXPECT_EQ(find_eyeballs(mesh.topology, {}).count, 0U);
  kinds.front() = SurfaceKind::kEye;
  const Eyeballs one = find_eyeballs(mesh.topology, kinds);
  EXPECT_EQ(one.count, 1U);
  EXPECT_EQ(std::count(one.of_vertex.begin(), one.of_vertex.end(), 0U), 3);
}

TEST(EyeAlbedo, PupilIsDarkestAndTheBackIsWhite) {
  const PlacedEye eye{{1, 2, 3}, 2};
  const Eigen::Vector3f gaze = Eigen::Vector3f::UnitZ();
  const auto at = [&](float sine) {
    return eye_albedo(eye, gaze,
                      eye.centre + 2 * Eigen::Vector3f(sine, 0, std::sqrt(1 - sine * sine)));
  };
  const Light white = albedo_of(SurfaceKind::kEye);
  EXPECT_LT(at(0).maxCoeff(), at(0.3F).minCoeff());
  EXPECT_TRUE((at(0.3F) < white).all());
  EXPECT_TRUE(at(0.6F).isApprox(white));
  EXPECT_TRUE(eye_albedo(eye, gaze, eye.centre - 2 * gaze).isApprox(white));
}

}  // namespace
}  // namespace crowdface
