// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/meshes.h"

namespace crowdface {
namespace {

using ::testing::HasSubstr;
using testing::make_topology;

TEST(FirstDifference, IsEmptyForEqualTopologies) {
  EXPECT_EQ(first_difference(testing::cube_topology(), testing::cube_topology()), "");
}

TEST(FirstDifference, NamesTheFaceAsObjCountsIt) {
  const Topology a = make_topology(4, {{0, 1, 2}, {0, 2, 3}});
  const Topology b = make_topology(4, {{0, 1, 2}, {0, 3, 2}});
  EXPECT_EQ(first_difference(a, b), "face 2: expected vertices 1 3 4, found 1 4 3");
}

TEST(FirstDifference, NamesCounts) {
  const Topology a = make_topology(4, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_THAT(first_difference(a, make_topology(5, {{0, 1, 2}, {0, 2, 3}})),
              HasSubstr("expected 4 vertices, found 5"));
  EXPECT_THAT(first_difference(a, make_topology(4, {{0, 1, 2}})),
              HasSubstr("expected 2 faces, found 1"));
}

}  // namespace
}  // namespace crowdface
