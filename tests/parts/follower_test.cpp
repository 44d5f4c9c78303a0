// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/follower.h"

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/all_columns.h"

#include "parts/scene.h"

namespace crowdface {
namespace {

struct TwoHeads {
  HeadSet faces;
  PartList parts;

  TwoHeads() {
    const Mesh mesh = testing::simple_head();
    faces.topology = mesh.topology;
    faces.heads.push_back({"ann", mesh.positions});
    Positions other = mesh.positions;
    other.col(0) *= 1.1;
    faces.heads.push_back({"bob", other});
    const Adjacency adjacency = build_adjacency(mesh.topology);
    const Components components = find_components(adjacency);
    parts = find_parts(mesh.topology, adjacency, components, mesh.positions);
    for (const Part& part : parts.parts) {
      moving.insert(moving.end(), part.vertices.begin(), part.vertices.end());
    }
  }
  PartFollower follower(PartShape shape = PartShape::kTarget) const {
    return {faces, parts, {}, shape};
  }
  std::vector<std::uint32_t> moving;  ///< all but skin
};

TEST(PartFollower, CarriesPartsWithTheWholeHead) {
  const TwoHeads scene;
  const PartFollower follower = scene.follower();
  for (Index target = 0; target < 2; ++target) {
    const Positions& head = scene.faces.heads[static_cast<std::size_t>(target)].positions;
    const Positions expected = testing::moved(head, 0.5, 1, {1, -2, 3});
    Positions result = expected;
    for (const std::uint32_t v : scene.moving) result.row(v).setConstant(-9);
    follower.move_parts(target, result);
    EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-10);
  }
}

// Each eyeball took the size that fitted its own lids, and a face squinted with eyes of two sizes.
TEST(PartFollower, ChangesTheSizeOfBothEyeballsAlike) {
  const TwoHeads scene;
  const Positions& head = scene.faces.heads[0].positions;
  Positions result = head;
  for (Index v = 0; v < result.rows(); ++v) result.row(v) *= head(v, 0) > 0 ? 1.06 : 1.01;
  scene.follower().move_parts(0, result);
  std::vector<double> growth;
  for (const Part& part : scene.parts.parts) {
    if (!part.is_eyeball) continue;
    const auto extent = [&](const Positions& positions) {
      const Positions rows = positions(part.vertices, kAllColumns);
      return (rows.rowwise() - rows.colwise().mean()).norm();
    };
    growth.push_back(extent(result) / extent(head));
  }
  ASSERT_EQ(growth.size(), 2U);
  EXPECT_NEAR(growth[0], growth[1], 1e-9);
  EXPECT_GT(growth[0], 1.005);
  EXPECT_LT(growth[0], 1.055);
}

TEST(PartFollower, KeepsTheTargetsPartsToTheBitWhereNothingMoved) {
  const TwoHeads scene;
  const Positions& head = scene.faces.heads[1].positions;
  Positions result = head;
  for (const std::uint32_t v : scene.moving) result.row(v).setConstant(-9);
  scene.follower().move_parts(1, result);
  EXPECT_TRUE(result == head);
}

/// The skin pushed in and out.
Positions bent(const Positions& head) {
  Positions result = head;
  for (Index v = 0; v < head.rows(); ++v) {
    result.row(v) *= 1 + 0.03 * std::sin(0.7 * head(v, 0)) * std::cos(0.5 * head(v, 1));
  }
  return result;
}

TEST(PartFollower, MovesRigidPartsAsAWholeAndLeavesTheSkin) {
  const TwoHeads scene;
  const Positions& head = scene.faces.heads[0].positions;
  const Positions blended = bent(head);
  Positions result = blended;
  scene.follower().move_parts(0, result);
  for (Index v = 0; v < scene.parts.shapes[0].vertex_count; ++v) {
    ASSERT_TRUE(result.row(v) == blended.row(v)) << "skin";
  }
  for (const Part& part : scene.parts.parts) {
    if (part.part_class != PartClass::kRigid) continue;
    const auto distance = [&](const Positions& mesh, std::size_t a, std::size_t b) {
      return (mesh.row(part.vertices[a]) - mesh.row(part.vertices[b])).norm();
    };
    const double scale = distance(result, 0, 5) / distance(head, 0, 5);
    EXPECT_NEAR(scale, 1, 0.1);
    for (std::size_t i = 1; i < part.vertices.size(); ++i) {
      EXPECT_NEAR(distance(result, 0, i), scale * distance(head, 0, i), 1e-10);
    }
  }
}

TEST(PartFollower, BlendsShapesIfAsked) {
  const TwoHeads scene;
  const Positions& head = scene.faces.heads[0].positions;
  Positions result = head;
  const Part& eye = scene.parts.parts[1];
  for (const std::uint32_t v : eye.vertices) {  // flatter, and elsewhere
    result(v, 2) = 0.8 * result(v, 2) + 5;
  }
  const Positions blended = result;
  scene.follower(PartShape::kBlend).move_parts(0, result);
  // As flat as blended up to its size, but in its place.
  const auto size = [&](const Positions& mesh, Index axis) {
    double low = 1e300, high = -1e300;
    for (const std::uint32_t v : eye.vertices) {
      low = std::min(low, mesh(v, axis));
      high = std::max(high, mesh(v, axis));
    }
    return std::pair((low + high) / 2, high - low);
  };
  EXPECT_NEAR(size(result, 2).second / size(result, 0).second, 0.8, 1e-9);
  EXPECT_NEAR(size(result, 2).first, size(head, 2).first, 1e-9);
}

TEST(PartFollower, HasTheSameBitsOnOneThreadAsOnMany) {
  const TwoHeads scene;
  const Positions blended = bent(scene.faces.heads[0].positions);
  Positions many = blended, one = blended;
  scene.follower().move_parts(0, many);
  const ThreadLimit limit(1);
  scene.follower().move_parts(0, one);
  EXPECT_TRUE(many == one);
}

}  // namespace
}  // namespace crowdface
