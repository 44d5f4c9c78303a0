// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/proximity_joiner.h"

#include <numeric>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

namespace crowdface {
namespace {

/// Components of three points each, some of them in clusters, in a box of 10.
struct Points {
  Positions positions;
  std::vector<std::uint32_t> rows, components;
};

Points random_points(std::uint64_t seed, std::uint32_t count) {
  Points points{Positions(count, 3), std::vector<std::uint32_t>(count), {}};
  std::iota(points.rows.begin(), points.rows.end(), 0U);
  for (std::uint32_t i = 0; i < count; ++i) {
    points.components.push_back(i / 3);
    const bool clustered = i / 3 % 4 == 0;
    for (const char* axis : {"x", "y", "z"}) {
      points.positions(i, axis[0] - 'x') =
          (clustered ? 0.5 : 3.0) * random_normal({seed, i, axis}) + (clustered ? 5 : 0);
    }
  }
  return points;
}

std::vector<std::uint32_t> roots(DisjointSets& groups, std::uint32_t count) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t c = 0; c < count; ++c) result.push_back(groups.root(c));
  return result;
}

TEST(DisjointSets, IsCalledAfterTheFirstOfAGroup) {
  DisjointSets groups(6);
  groups.join(5, 4);
  groups.join(2, 5);
  groups.join(3, 1);
  EXPECT_EQ(roots(groups, 6), (std::vector<std::uint32_t>{0, 1, 2, 1, 2, 2}));
  for (const std::uint32_t c : {2U, 4U, 5U}) groups.release(c);
  EXPECT_EQ(roots(groups, 6), (std::vector<std::uint32_t>{0, 1, 2, 1, 4, 5}));
}

TEST(ProximityJoiner, JoinsWhatEveryPairTellsToJoin) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::uint32_t count = 30 * (static_cast<std::uint32_t>(seed) + 1);
    const double reach = 0.1 * static_cast<double>(seed % 7);
    const Points points = random_points(seed, count);
    DisjointSets plain(count / 3), groups(count / 3);
    ProximityJoiner tree(points.positions, points.rows, points.components, groups);
    for (const std::uint32_t a : points.rows) {
      const Eigen::Vector3d place = points.positions.row(a).transpose();
      for (const std::uint32_t b : points.rows) {
        const double distance = (points.positions.row(b).transpose() - place).norm();
        if (distance <= reach) plain.join(points.components[a], points.components[b]);
      }
      tree.join_near(place, reach, points.components[a]);
      ASSERT_EQ(roots(groups, count / 3), roots(plain, count / 3)) << seed << ' ' << a;
    }
  }
}

TEST(ProximityJoiner, CountsTheReachItself) {
  Positions points(2, 3);
  points << 0, 0, 0, 0.6, 0.8, 0;
  const std::vector<std::uint32_t> components = {0, 1};
  DisjointSets groups(2);
  ProximityJoiner tree(points, {1}, components, groups);
  tree.join_near({0, 0, 0}, std::nextafter(1.0, 0.0), 0);
  EXPECT_EQ(groups.root(1), 1U);
  tree.join_near({0, 0, 0}, 1, 0);
  EXPECT_EQ(groups.root(1), 0U);
  ProximityJoiner(points, {}, components, groups).join_near({0, 0, 0}, 1, 0);
}

}  // namespace
}  // namespace crowdface
