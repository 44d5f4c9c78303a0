// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/contact.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "parts/scene.h"

namespace crowdface {
namespace {

constexpr double kMargin = 0.05;

/// A box a millimetre behind a wall of skin, both seen from +z.
struct BoxBehindWall {
  Mesh mesh = testing::Shapes()
                  .strip({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, 12)
                  .box({-1, -1, -1}, {1, 1, -0.1})
                  .mesh();
  Index skin = mesh.topology.vertex_count - 8;
  VertexFaces faces{mesh.topology};
  std::vector<std::uint32_t> front = {
      static_cast<std::uint32_t>(skin + 4), static_cast<std::uint32_t>(skin + 5),
      static_cast<std::uint32_t>(skin + 6), static_cast<std::uint32_t>(skin + 7)};

  PartContact contact(const std::vector<Head>& heads) const {
    std::vector<std::uint32_t> wall(static_cast<std::size_t>(skin));
    std::iota(wall.begin(), wall.end(), 0U);
    return {mesh.topology, faces, mesh.positions, PointGrid(mesh.positions, wall), wall,
            front,         0.6,   heads};
  }
  PartContact contact() const { return contact({{"ann", mesh.positions}}); }
  /// The wall pushed back, and tilted about the up axis.
  Positions pushed(double by, double tilt = 0) const {
    Positions after = mesh.positions;
    after.topRows(skin).col(2).array() += -by + tilt * after.topRows(skin).col(0).array();
    return after;
  }
  /// The least distance of the box's front from such a wall; negative: through it.
  double clearance(const RigidMotion& motion, double by, double tilt = 0) const {
    double least = 1e300;
    for (const std::uint32_t v : front) {
      const Eigen::Vector3d point = motion.apply(mesh.positions.row(v).transpose());
      least = std::min(least, -by + tilt * point.x() - point.z());
    }
    return least / std::sqrt(1 + tilt * tilt);
  }
};

TEST(Contact, KnowsHeightsWhicheverWayFacesLook) {
  const BoxBehindWall scene;
  const PartContact contact = scene.contact();
  ASSERT_EQ(contact.size(), 4U);
  for (std::size_t i = 0; i < contact.size(); ++i) {
    const Eigen::Vector3d point = scene.mesh.positions.row(scene.front[i]).transpose();
    EXPECT_NEAR(contact.height(i, point, scene.mesh.positions).height, 0.1, 1e-12);
    EXPECT_NEAR(contact.height(i, point, scene.pushed(0.3)).height, -0.2, 1e-12);
    EXPECT_NEAR(contact.height(i, point, scene.pushed(0.3)).outward.z(), -1, 1e-12);
  }
}

TEST(Contact, LeavesAPartThatIsClear) {
  const BoxBehindWall scene;
  const RigidMotion motion =
      scene.contact().keep_out_of_skin(scene.mesh.positions, {}, scene.pushed(0.04), kMargin);
  EXPECT_EQ(motion.moved_pivot.norm(), 0);
  EXPECT_EQ(motion.scale, 1);
}

TEST(Contact, ClearsAPartOfTheSkin) {
  const BoxBehindWall scene;
  const RigidMotion motion =
      scene.contact().keep_out_of_skin(scene.mesh.positions, {}, scene.pushed(0.3), kMargin);
  EXPECT_NEAR(scene.clearance(motion, 0.3), kMargin, 0.003);
  EXPECT_NEAR(motion.moved_pivot.x(), 0, 1e-9);
}

TEST(Contact, TurnsAPartBehindATiltedWall) {
  const BoxBehindWall scene;
  const RigidMotion motion =
      scene.contact().keep_out_of_skin(scene.mesh.positions, {}, scene.pushed(0.1, 0.15), kMargin);
  EXPECT_LT(scene.clearance({}, 0.1, 0.15), -0.1);
  EXPECT_GT(scene.clearance(motion, 0.1, 0.15), 0.5 * kMargin);
  EXPECT_LT(motion.apply_to_direction({1, 0, 0}).z(), 0.15);
  EXPECT_GT(motion.apply_to_direction({1, 0, 0}).z(), 0.01) << "turned some of the way";
}

TEST(Contact, AllowsWhatAHeadHas) {
  const BoxBehindWall scene;
  const Positions through = scene.pushed(0.3);
  const PartContact contact = scene.contact({{"ann", scene.mesh.positions}, {"bob", through}});
  EXPECT_EQ(contact.keep_out_of_skin(through, {}, through, kMargin).moved_pivot.norm(), 0);
  const RigidMotion motion =
      contact.keep_out_of_skin(scene.mesh.positions, {}, scene.pushed(0.4), kMargin);
  EXPECT_NEAR(scene.clearance(motion, 0.4), -0.2, 0.005) << "no deeper than in any head";
}

// Teeth that did not fit between open lips moved by centimetres, and differently after a change of
// the scan by a micrometre.
TEST(Contact, APartThatFitsNowhereStaysNear) {
  constexpr double kReach = 0.6;
  const Mesh mesh = testing::Shapes()
                        .strip({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, 12)
                        .strip({-3, -3, -1.1}, {0, 6, 0}, {6, 0, 0}, 12)
                        .box({-1, -1, -1}, {1, 1, -0.1})
                        .mesh();
  const Index skin = mesh.topology.vertex_count - 8;
  const VertexFaces faces{mesh.topology};
  std::vector<std::uint32_t> walls(static_cast<std::size_t>(skin)), box(8);
  std::iota(walls.begin(), walls.end(), 0U);
  std::iota(box.begin(), box.end(), static_cast<std::uint32_t>(skin));
  const PartContact contact(mesh.topology, faces, mesh.positions, PointGrid(mesh.positions, walls),
                            walls, box, kReach, {{"ann", mesh.positions}});
  // The gap between the walls is too narrow for the box, and widens slowly along +x.
  const auto shift = [&](double widening) -> Eigen::Vector3d {
    Positions narrow = mesh.positions;
    for (Index v = 0; v < skin; ++v) {
      const double by = 0.15 - widening * narrow(v, 0);
      narrow(v, 2) += narrow(v, 2) > -0.5 ? -by : by;
    }
    return contact.keep_out_of_skin(mesh.positions, {}, narrow, kMargin).apply({0, 0, -0.55}) -
           Eigen::Vector3d(0, 0, -0.55);
  };
  EXPECT_LT(shift(0.02).norm(), kReach);
  EXPECT_LT((shift(0.02) - shift(0.0201)).norm(), 0.02 * kReach);
}

}  // namespace
}  // namespace crowdface
