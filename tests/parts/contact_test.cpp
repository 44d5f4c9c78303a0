// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/contact.h"

#include <numeric>

#include <gtest/gtest.h>

#include "parts/scene.h"

namespace crowdface {
namespace {

/// A box a millimetre behind a wall of skin, both seen from +z.
struct Scene {
  Mesh mesh = testing::Shapes()
                  .strip({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, 12)
                  .box({-1, -1, -1}, {1, 1, -0.1})
                  .mesh();
  Index skin = mesh.topology.vertex_count - 8;
  FacesAround faces{mesh.topology};
  std::vector<std::uint32_t> box = {
      static_cast<std::uint32_t>(skin + 4), static_cast<std::uint32_t>(skin + 5),
      static_cast<std::uint32_t>(skin + 6), static_cast<std::uint32_t>(skin + 7)};
  Contact contact = find();

  Contact find() const {
    std::vector<std::uint32_t> wall(static_cast<std::size_t>(skin));
    std::iota(wall.begin(), wall.end(), 0U);
    return {mesh.topology, faces, mesh.positions, PointGrid(mesh.positions, wall), box, 0.3};
  }
};

TEST(Contact, KnowsHeightsWhicheverWayFacesLook) {
  const Scene scene;
  ASSERT_EQ(scene.contact.size(), 4U);
  for (const double height : scene.contact.heights(scene.mesh.positions)) {
    EXPECT_NEAR(height, 0.1, 1e-12);
  }
}

TEST(Contact, LeavesAPartThatIsClear) {
  const Scene scene;
  Positions after = scene.mesh.positions;
  after.topRows(scene.skin).col(2).array() -= 0.04;
  const auto before = scene.contact.heights(scene.mesh.positions);
  EXPECT_EQ(scene.contact.clearing_shift(scene.mesh.positions, before, {}, after, 0.05).norm(), 0);
}

TEST(Contact, ClearsAPartOfTheSkin) {
  const Scene scene;
  Positions after = scene.mesh.positions;
  after.topRows(scene.skin).col(2).array() -= 0.3;  // the wall comes 2 mm through the box
  const auto before = scene.contact.heights(scene.mesh.positions);
  const Eigen::Vector3d shift =
      scene.contact.clearing_shift(scene.mesh.positions, before, {}, after, 0.05);
  EXPECT_NEAR(shift.z(), -0.25, 0.02) << "until the margin is left";
  EXPECT_NEAR(shift.x(), 0, 1e-12);
}

TEST(Contact, AllowsWhatTheTargetHas) {
  const Scene scene;
  Positions target = scene.mesh.positions;
  target.topRows(scene.skin).col(2).array() -= 0.3;
  const auto before = scene.contact.heights(target);
  EXPECT_EQ(scene.contact.clearing_shift(target, before, {}, target, 0.05).norm(), 0);
}

}  // namespace
}  // namespace crowdface
