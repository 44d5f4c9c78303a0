// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/eyeballs.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "render/shapes.h"

namespace crowdface {
namespace {

/// Two spheres in one mesh, the second of radius 2 around (10, 0, 0).
Mesh two_balls() {
  return join_meshes(make_sphere(1, 8, 12), make_sphere(2, 8, 12), {10, 0, 0});
}

TEST(Eyeballs, EachConnectedPartIsOne) {
  const Mesh mesh = two_balls();
  const std::vector<SurfaceKind> kinds(static_cast<std::size_t>(mesh.topology.face_count()),
                                       SurfaceKind::kEye);
  const Eyeballs eyeballs = find_eyeballs(mesh.topology, kinds);
  ASSERT_EQ(eyeballs.count, 2U);
  std::vector<float> points(mesh.positions.data(), mesh.positions.data() + mesh.positions.size());
  const auto eyes = eyeball_spheres(eyeballs, points, Eigen::Vector3f::UnitZ());
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
  EXPECT_EQ(std::count(one.eyeball_of_vertex.begin(), one.eyeball_of_vertex.end(), 0U), 3);
}

TEST(EyeAlbedo, PupilIsDarkestAndTheBackIsWhite) {
  const EyeballSphere eye{{1, 2, 3}, 2};
  const Eigen::Vector3f gaze = Eigen::Vector3f::UnitZ();
  const auto at = [&](float sine) {
    return eye_albedo(eye, gaze,
                      eye.centre + 2 * Eigen::Vector3f(sine, 0, std::sqrt(1 - sine * sine)));
  };
  const LinearRgb white = albedo_of(SurfaceKind::kEye);
  EXPECT_LT(at(0).maxCoeff(), at(0.3F).minCoeff());
  EXPECT_TRUE((at(0.3F) < white).all());
  EXPECT_TRUE(at(0.6F).isApprox(white));
  EXPECT_TRUE(eye_albedo(eye, gaze, eye.centre - 2 * gaze).isApprox(white));
}

}  // namespace
}  // namespace crowdface
