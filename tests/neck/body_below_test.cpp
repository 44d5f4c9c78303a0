// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/body_below.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/mesh/all_columns.h"

#include "support/expect_error.h"
#include "support/meshes.h"
#include "tube.h"

namespace crowdface {
namespace {

using testing::expect_error;
using testing::Tube;

const Eigen::Vector3d kUp(0, 1, 0);

Rim ring(const Tube& tube, std::uint32_t row) {
  Rim rim = tube.rim();
  for (std::uint32_t& v : rim) v += row * tube.around;
  return rim;
}

TEST(PolygonsBelow, AreOnOneSideOfTheLoop) {
  const Tube tube;
  const std::vector<bool> below =
      polygons_below(tube.topology(), tube.positions(), ring(tube, 5), kUp);
  for (std::size_t f = 0; f < below.size(); ++f) EXPECT_EQ(below[f], f < 5 * tube.around) << f;
}

// The loop lies in a plane at 40 degrees, so that some polygons below it are higher than its middle.
TEST(PolygonsBelow, FollowASlopingLoop) {
  const Tube tube;
  Positions positions = tube.positions();
  positions.col(1) += 0.8 * positions.col(0);
  const std::vector<bool> below = polygons_below(tube.topology(), positions, ring(tube, 5), kUp);
  for (std::size_t f = 0; f < below.size(); ++f) EXPECT_EQ(below[f], f < 5 * tube.around) << f;
}

TEST(PolygonsBelow, HaveSeparatePartsByTheirHeight) {
  const Tube tube;
  Topology topology = tube.topology();
  Positions positions = tube.positions();
  const auto first = static_cast<std::uint32_t>(positions.rows());
  positions.conservativeResize(first + 6, Eigen::NoChange);
  positions.bottomRows(6) << 0, 10, 0, 9, 10, 0, 0, 10, 9, 0, 90, 0, 9, 90, 0, 0, 90, 9;
  topology.add_face(std::vector<std::uint32_t>{first, first + 1, first + 2});
  topology.add_face(std::vector<std::uint32_t>{first + 3, first + 4, first + 5});
  topology.vertex_count = positions.rows();
  const std::vector<bool> below = polygons_below(topology, positions, ring(tube, 5), kUp);
  EXPECT_TRUE(below[below.size() - 2]);
  EXPECT_FALSE(below.back());
}

TEST(PolygonsBelow, AreAllAtAnOpenRim) {
  const Tube tube;
  const std::vector<bool> below =
      polygons_below(tube.topology(), tube.positions(), ring(tube, 12), kUp);
  EXPECT_EQ(std::ranges::count(below, true), 12 * tube.around);
}

TEST(PolygonsBelow, NeedALoopThatSeparatesThem) {
  const Tube tube;  // closed to a torus: its last ring is its first
  Topology topology = tube.topology();
  const std::uint32_t last = tube.rows * tube.around;
  for (std::uint32_t& v : topology.corner_vertices) v = v >= last ? v - last : v;
  expect_error(ExitCode::kBadData, {"does not separate"},
               [&] { polygons_below(topology, tube.positions(), ring(tube, 5), kUp); });
}

}  // namespace
}  // namespace crowdface
