// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/ray_scene.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/shapes.h"

namespace crowdface {
namespace {

/// Leaves numbers that no scene reaches to where the next function's variables will be.
[[gnu::noinline]] int litter_the_stack() {
  volatile unsigned char litter[16384];
  for (volatile unsigned char& byte : litter) byte = 0x7e;
  return litter[100];
}

// Rays go in packets of sixteen. What stood in the lanes of a packet that had no ray was taken for rays, on processors
// without vectors of sixteen, and ended the program.
TEST(RayScene, AnyNumberOfRaysMeetsASquare) {
  const RayDevice device;
  const std::vector<Quad> quads = {{0, 1, 2, 3}};
  const RayScene scene(device, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, quads);
  for (std::size_t count = 0; count <= 33; ++count) {
    SCOPED_TRACE(count);
    std::vector<Ray> rays;
    for (std::size_t r = 0; r < count; ++r) {  // every third passes beside it
      const float x = r % 3 == 2 ? 1.5F : static_cast<float>(r) / 40;
      rays.push_back({{x, 0.25F, 2}, {0, 0, -1}});
    }
    EXPECT_EQ(litter_the_stack(), 0x7e);
    const std::vector<bool> blocked = scene.occluded(rays);
    EXPECT_EQ(litter_the_stack(), 0x7e);
    const auto hits = scene.nearest_hits(rays);
    ASSERT_EQ(blocked.size(), count);
    ASSERT_EQ(hits.size(), count);
    for (std::size_t r = 0; r < count; ++r) {
      EXPECT_EQ(blocked[r], r % 3 != 2) << r;
      ASSERT_EQ(hits[r].has_value(), r % 3 != 2) << r;
      if (hits[r]) {
        EXPECT_FLOAT_EQ(hits[r]->distance, 2);
      }
    }
  }
}

// Embree 4.3 refits trees over quads so that rays pass through what has moved.
TEST(RayScene, MovedPointsKeepOutTheLightAsPointsOfANewSceneDo) {
  const RayDevice device;
  const Mesh sphere = make_sphere(1, 40, 80);
  std::vector<Quad> quads;
  for (Index f = 0; f < sphere.topology.face_count(); ++f) {
    const auto corners = sphere.topology.face(f);
    quads.push_back({corners[0], corners[1], corners[2], corners.back()});
  }
  const auto points = [&](float size, float right) {
    std::vector<float> all;
    for (Index v = 0; v < sphere.positions.rows(); ++v) {
      for (Index c = 0; c < 3; ++c) {
        all.push_back(size * static_cast<float>(sphere.positions(v, c)) + (c == 0 ? right : 0));
      }
    }
    return all;
  };
  std::vector<Ray> rays;
  for (float x = -2.03F; x < 5; x += 0.11F) {
    for (float y = -2.03F; y < 2.2F; y += 0.11F) rays.push_back({{x, y, 10}, {0, 0, -1}});
  }
  RayScene moving(device, points(1, 0), quads, RayScene::Tree::kMovable);
  for (const auto& [size, right] : {std::pair{1.0F, 3.0F}, {2.0F, 0.0F}, {1.0F, 0.0F}}) {
    const RayScene anew(device, points(size, right), quads);
    auto moved = points(size, right);
    moving.set_points(moved);
    EXPECT_EQ(moving.occluded(rays), anew.occluded(rays)) << size << ' ' << right;
  }
}

}  // namespace
}  // namespace crowdface
