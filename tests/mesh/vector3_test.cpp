// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/vector3.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

namespace crowdface {
namespace {

/// Adds from left to right. Other orders give other last digits for some of the vectors below.
double left_to_right(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

Positions random_rows(Index count, std::uint64_t seed) {
  Positions rows(count, 3);
  for (Index i = 0; i < rows.size(); ++i) {
    rows.data()[i] = random_between({.seed = seed, .index = static_cast<std::uint32_t>(i)}, -1, 1);
  }
  return rows;
}

TEST(Vector3, EigenSumsThreeProductsFromLeftToRight) {
  const Positions a = random_rows(1000, 1), b = random_rows(1000, 2);
  for (Index i = 0; i < a.rows(); ++i) {
    const Eigen::Vector3d from = row3(a, i) - row3(b, i);
    ASSERT_EQ(row3(a, i).dot(row3(b, i)), left_to_right(row3(a, i), row3(b, i)));
    ASSERT_EQ((row3(a, i) - row3(b, i)).dot(row3(b, i)), left_to_right(from, row3(b, i)));
    ASSERT_EQ((row3(a, i) - row3(b, i)).norm(), std::sqrt(left_to_right(from, from)));
    ASSERT_EQ(from.squaredNorm(), left_to_right(from, from));
    const Eigen::Vector3d unit = from / std::sqrt(left_to_right(from, from));
    ASSERT_EQ(from.normalized(), unit);
  }
}

TEST(Vector3, TheDirectionOfAZeroVectorIsZero) {
  EXPECT_EQ(Eigen::Vector3d::Zero().normalized(), Eigen::Vector3d(0, 0, 0));
}

}  // namespace
}  // namespace crowdface
