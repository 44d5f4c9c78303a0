// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/point_carrier.h"

#include <gtest/gtest.h>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/rigid_motion.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {
namespace {

struct HeadsWithPoints {
  HeadSet faces;
  PartList parts;
  std::vector<std::uint32_t> skin;
  std::vector<Triangle> triangles;

  HeadsWithPoints() {
    const SyntheticHeads synthetic(5000, SyntheticHeads::Parts::kEyesAndTeeth);
    faces = {synthetic.topology(), synthetic.uvs(), {}};
    for (const std::uint64_t i : {0, 1, 2}) {
      faces.heads.push_back({"head" + std::to_string(i), synthetic.positions(5, i)});
    }
    triangles = triangles_of(faces.topology);
    const Adjacency adjacency = build_adjacency(faces.topology);
    const Components components = find_components(adjacency);
    parts = find_parts(faces.topology, adjacency, components, mean_head(faces));
    for (std::uint32_t v = 0; v < components.component_of_vertex.size(); ++v) {
      if (components.component_of_vertex[v] == components.largest()) skin.push_back(v);
    }
  }
  const Positions& operator[](std::size_t i) const { return faces.heads[i].positions; }
  const Part& eye() const {
    for (const Part& part : parts.parts) {
      if (part.is_eyeball) return part;
    }
    throw std::logic_error("no eyeball");
  }
  Eigen::Vector3d middle_of_eye(const Positions& head) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t v : eye().ball_vertices) sum += row3(head, v);
    return sum / static_cast<double>(eye().ball_vertices.size());
  }
  /// The middle of an eye, the tip of the nose and a place deep in the head.
  PointSet points(const std::vector<std::size_t>& of_heads) const {
    PointSet set{{"eye", "tip", "neck"}, {}, {}};
    for (const std::size_t h : of_heads) {
      Index tip = 0;
      (*this)[h].col(2).maxCoeff(&tip);
      Positions rows(3, 3);
      rows.row(0) = middle_of_eye((*this)[h]).transpose();
      rows.row(1) = (*this)[h].row(tip);
      rows.row(2) = (*this)[h].colwise().mean();
      set.positions.push_back(rows);
      set.meshes.push_back((*this)[h]);
    }
    return set;
  }
};

TEST(PointCarrier, LeavesPointsOfTheirOwnMesh) {
  const HeadsWithPoints heads;
  const PointSet points = heads.points({0});
  const PointCarrier carrier(points, heads.parts, heads.skin, heads.triangles);
  EXPECT_LT((carrier.place_points(0, heads[0]) - points.positions[0]).norm(), 1e-9);
}

TEST(PointCarrier, MovesThemWithAFaceThatIsTurnedMovedAndScaled) {
  const HeadsWithPoints heads;
  const PointSet points = heads.points({0});
  const PointCarrier carrier(points, heads.parts, heads.skin, heads.triangles);
  RigidMotion motion;
  motion.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  motion.scale = 1.25;
  motion.moved_pivot = {3, -2, 7};
  Positions face = heads[0];
  for (Index v = 0; v < face.rows(); ++v) {
    face.row(v) = motion.apply(row3(heads[0], v)).transpose();
  }
  const Positions carried = carrier.place_points(0, face);
  for (Index p = 0; p < 3; ++p) {
    EXPECT_LT((row3(carried, p) - motion.apply(row3(points.positions[0], p))).norm(), 1e-9) << p;
  }
}

TEST(PointCarrier, KeepsPivotsInTheMiddleOfEyes) {
  const HeadsWithPoints heads;
  const PointSet points = heads.points({0});
  const PointCarrier carrier(points, heads.parts, heads.skin, heads.triangles);
  for (const std::size_t face : {1, 2}) {
    const Positions carried = carrier.place_points(0, heads[face]);
    EXPECT_GT((row3(carried, 0) - row3(points.positions[0], 0)).norm(), 1e-3) << "it went along";
    EXPECT_LT((row3(carried, 0) - heads.middle_of_eye(heads[face])).norm(), 1e-6);
    // Both heads know where the tip of their own nose is: a centimetre apart is another place.
    EXPECT_LT((row3(carried, 1) - row3(heads.points({face}).positions[0], 1)).norm(), 1);
  }
}

// A point on the surface moved with the skin around it, and left its vertex by up to millimetres.
TEST(PointCarrier, KeepsPointsOnTheirVerticesAndTriangles) {
  const HeadsWithPoints heads;
  const Triangle corners = heads.triangles[heads.triangles.size() / 3];
  PointSet points{{"vertex", "middle"}, {Positions(2, 3)}, {heads[0]}};
  const auto place = [&](const Positions& head) {
    Positions rows(2, 3);
    rows.row(0) = head.row(corners[1]);
    rows.row(1) =
        0.2 * head.row(corners[0]) + 0.3 * head.row(corners[1]) + 0.5 * head.row(corners[2]);
    return rows;
  };
  points.positions[0] = place(heads[0]);
  points.positions[0].array() += 1e-6;  // cm, as files round
  const PointCarrier carrier(points, heads.parts, heads.skin, heads.triangles);
  const PointCarrier with_the_skin(points, heads.parts, heads.skin, {});
  for (const std::size_t face : {1, 2}) {
    const Positions wanted = place(heads[face]);
    EXPECT_LT((carrier.place_points(0, heads[face]) - wanted).norm(), 1e-5) << face;
    EXPECT_GT((with_the_skin.place_points(0, heads[face]) - wanted).norm(), 1e-3) << face;
  }
}

TEST(PointCarrier, TakesThoseOfTheTargetWhereEachHeadHasSome) {
  const HeadsWithPoints heads;
  const PointSet points = heads.points({0, 1, 2});
  const PointCarrier carrier(points, heads.parts, heads.skin, heads.triangles);
  for (Index h = 0; h < 3; ++h) {
    const auto head = static_cast<std::size_t>(h);
    EXPECT_LT((carrier.place_points(h, heads[head]) - points.positions[head]).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace crowdface
