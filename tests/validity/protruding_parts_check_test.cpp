// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/protruding_parts_check.h"

#include <array>

#include <gtest/gtest.h>

#include "crowdface/mesh/adjacency.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

/// A sheet of skin, 8 by 8 at height 0, and a cube with edges of 2 whose middle is at a height.
struct Scene {
  static constexpr std::uint32_t kSide = 9;  // vertices
  Scene() {
    const Topology cube = testing::cube_topology();
    topology = testing::grid_topology(kSide - 1, kSide - 1);
    for (Index f = 0; f < cube.face_count(); ++f) {
      for (const std::uint32_t v : cube.face(f)) {
        topology.corner_vertices.push_back(v + kSide * kSide);
      }
      topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
    }
    topology.vertex_count += cube.vertex_count;
    components = find_components(build_adjacency(topology));
  }
  Positions at(double height) const {
    Positions positions(topology.vertex_count, 3);
    for (Index v = 0; v < kSide * kSide; ++v) {
      positions.row(v) << static_cast<double>(v % kSide), static_cast<double>(v / kSide), 0;
    }
    positions.bottomRows(8) =
        testing::cube_positions().rowwise() + Eigen::RowVector3d(4.3, 4.3, height);
    return positions;
  }
  Topology topology;
  Components components;
};

TEST(ProtrudingPartsCheck, MeasuresTheVisibleAreaThatPassesThroughTheSkin) {
  const Scene scene;
  const std::array<std::uint32_t, 1> parts{1U - scene.components.largest()};
  const ViewSetup around{{{2, 0.3, 1}, {-2, 0.3, 1}, {0.3, 2, 1}, {0.3, -2, 1}}, 10};
  const ProtrudingPartsCheck check(scene.topology, scene.components, parts, scene.at(0), around);
  EXPECT_EQ(check.exposed_mm2(scene.at(-2)), 0) << "behind the skin";
  // The four sides, 2 wide and 1 high above the skin.
  EXPECT_NEAR(check.exposed_mm2(scene.at(0)), 800, 160);
  EXPECT_EQ(check.exposed_mm2(scene.at(2)), 0) << "in front of it and apart, as glasses are";
  const ViewSetup below{{{0.2, 0.3, -1}, {-0.2, 0.3, -1}}, 10};
  const ProtrudingPartsCheck other(scene.topology, scene.components, parts, scene.at(0), below);
  EXPECT_GT(other.exposed_mm2(scene.at(0)), 0);
  const ProtrudingPartsCheck no_parts(scene.topology, scene.components, {}, scene.at(0), around);
  EXPECT_EQ(no_parts.exposed_mm2(scene.at(0)), 0);
}

}  // namespace
}  // namespace crowdface
