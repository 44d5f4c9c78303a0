// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/anchors.h"

#include <numeric>

#include <gtest/gtest.h>

#include "parts/scene.h"

namespace crowdface {
namespace {

/// A ball of skin and a lash on it.
struct BallWithLash {
  Mesh mesh = testing::Shapes()
                  .ball({0, 0, 0}, 10, 24)
                  .strip({1.5, 5.2, 8.7}, {3, -0.4, 0}, {0, 0.3, 0.8})
                  .mesh();
  Index skin = mesh.topology.vertex_count - 27;
  Anchors anchors = bind();

  Anchors bind() const {
    std::vector<std::uint32_t> all(static_cast<std::size_t>(skin));
    std::iota(all.begin(), all.end(), 0U);
    std::vector<std::uint32_t> lash(27);
    std::iota(lash.begin(), lash.end(), static_cast<std::uint32_t>(skin));
    return {mesh.topology, VertexFaces(mesh.topology), mesh.positions,
            PointGrid(mesh.positions, all), lash};
  }
};

TEST(Anchors, CarryTheBoundWithTheSkin) {
  const BallWithLash scene;
  const Positions expected = testing::moved(scene.mesh.positions, 0.6, 1, {3, 4, 5});
  Positions result = expected;
  result.bottomRows(27).setZero();
  scene.anchors.place_vertices(scene.mesh.positions,
                               scene.anchors.measure_offsets(scene.mesh.positions), result);
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Anchors, KeepHeightsWhereTheSkinBulges) {
  const BallWithLash scene;
  Positions result = 1.1 * scene.mesh.positions;
  scene.anchors.place_vertices(scene.mesh.positions,
                               scene.anchors.measure_offsets(scene.mesh.positions), result);
  for (Index v = scene.skin; v < result.rows(); ++v) {
    const double before = scene.mesh.positions.row(v).norm() - 10;
    EXPECT_NEAR(result.row(v).norm() - 11, before, 0.05) << "as far off the skin as before";
  }
}

TEST(Anchors, KeepTheTargetWhereNothingMoved) {
  const BallWithLash scene;
  Positions result = scene.mesh.positions;
  result.bottomRows(27).setConstant(7);
  scene.anchors.place_vertices(scene.mesh.positions,
                               scene.anchors.measure_offsets(scene.mesh.positions), result);
  EXPECT_TRUE(result == scene.mesh.positions);
}

}  // namespace
}  // namespace crowdface
