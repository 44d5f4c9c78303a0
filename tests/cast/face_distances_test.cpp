// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_distances.h"

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace crowdface {
namespace {

using testing::random_positions;

TEST(FaceDistances, AreThoseOfPairs) {
  constexpr Index kVertices = 2500;  // three blocks of rows
  const Positions all = random_positions(3 * kVertices, 1);
  std::vector<Eigen::Map<const Positions>> faces;
  for (Index f = 0; f < 3; ++f) faces.emplace_back(all.row(f * kVertices).data(), kVertices, 3);
  std::vector<double> areas;
  for (Index i = 0; i < kVertices; ++i) areas.push_back(static_cast<double>(i % 7));
  const Eigen::MatrixXd distances = face_distances(faces, areas);
  EXPECT_EQ(distances, distances.transpose());
  EXPECT_EQ(distances.diagonal().norm(), 0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(distances(static_cast<Index>(i), static_cast<Index>(j)),
                face_distance(faces[i], faces[j], areas));
    }
  }
  EXPECT_GT(distances(1, 0), 0);
}

}  // namespace
}  // namespace crowdface
