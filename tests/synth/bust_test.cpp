// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/bust.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/vector3.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {
namespace {

/// The numbers of polygons at each edge.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges_of(const Topology& topology) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t c = 0; c < face.size(); ++c) {
      ++edges[std::minmax(face[c], face[(c + 1) % face.size()])];
    }
  }
  return edges;
}

TEST(Bust, BeginsAtTheRimOfTheAverageHead) {
  for (const auto parts : {SyntheticHeads::Parts::kSkin, SyntheticHeads::Parts::kEyesAndTeeth}) {
    const SyntheticHeads heads(9000, parts);
    const Mesh body = heads.body();
    const Positions head = heads.average();
    std::map<std::pair<double, double>, double> at;  // heights of the head's vertices
    for (Index v = 0; v < head.rows(); ++v) at[{head(v, 0), head(v, 2)}] = head(v, 1);
    Index rim = 0;
    while (at.contains({body.positions(rim, 0), body.positions(rim, 2)})) {
      EXPECT_EQ(body.positions(rim, 1),
                at[std::pair(body.positions(rim, 0), body.positions(rim, 2))]);
      ++rim;
    }
    EXPECT_EQ(head.col(1).minCoeff(), body.positions.col(1).head(rim).minCoeff());
    // Two loops of that many open edges: the rim and the lower end.
    const auto edges = edges_of(body.topology);
    const auto open =
        std::ranges::count_if(edges, [](const auto& edge) { return edge.second == 1; });
    EXPECT_EQ(open, 2 * rim);
    EXPECT_EQ(body.positions.rows() % rim, 0);
  }
}

/// The largest z of the bust's front near a point (x, y) of the front view, cm.
double front_at(double x, double y) {
  double z = -100;
  constexpr int kSide = 600;
  for (int i = 0; i < kSide * kSide; ++i) {  // the front half of the texture
    const int row = i / kSide, column = i % kSide;
    const Eigen::RowVector2d uv(static_cast<double>(column) / kSide, 0.5 * row / kSide);
    const Eigen::Vector3d point = synth::bust_point(uv);
    if (std::hypot(std::abs(point.x()) - x, point.y() - y) < 0.15) z = std::max(z, point.z());
  }
  return z;
}

TEST(Bust, HasCollarbonesWithANotchBetween) {
  // The collarbone lies more than 4 mm in front of the mean of two points above and below it.
  const double bone = front_at(5, -21.2);
  EXPECT_GT(bone - (front_at(5, -20) + front_at(5, -22.4)) / 2, 0.4);
  // Without a notch, z rises outwards from the middle more and more quickly.
  const double middle = front_at(0, -21.8), beside = front_at(2.2, -21.8);
  EXPECT_GT(beside - middle, front_at(4.4, -21.8) - beside);
}

TEST(Bust, IsASmoothSurfaceThatFacesOutward) {
  const SyntheticHeads heads(9000);
  const Mesh body = heads.body();
  const Positions areas = face_area_vectors(body.topology, body.positions);
  Positions normals = areas;
  for (Index f = 0; f < normals.rows(); ++f) normals.row(f).normalize();
  for (Index f = 0; f < normals.rows(); ++f) {
    Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
    for (const std::uint32_t v : body.topology.face(f)) middle += body.positions.row(v) / 4;
    const Eigen::RowVector3d off(middle.x(), 0, middle.z() + 3.1);
    EXPECT_GT(normals.row(f).dot(off.normalized() + Eigen::RowVector3d(0, 1, 0)), 0) << f;
  }
  // Neighbours in a ring and along a section have nearly the same normals.
  for (Index f = 0; f + 1 < normals.rows(); ++f) {
    EXPECT_GT(normals.row(f).dot(normals.row(f + 1)), 0.95) << f;
  }
  // The neck goes on below the rim: its normals differ little from those of the lowest polygons.
  const Positions head = heads.average();
  const double low = head.col(1).minCoeff();
  for (Index f = 0; f < heads.topology().face_count(); ++f) {
    const auto face = heads.topology().face(f);
    if (std::ranges::none_of(face, [&](std::uint32_t v) { return head(v, 1) == low; })) continue;
    Index nearest = 0;
    Positions middles(normals.rows(), 3);
    for (Index b = 0; b < middles.rows(); ++b) {
      middles.row(b) = body.positions.row(body.topology.face(b)[0]);
    }
    (middles.rowwise() - head.row(face[0])).rowwise().norm().minCoeff(&nearest);
    const Eigen::Vector3d above = face_area_vector(heads.topology(), f, head).normalized();
    EXPECT_GT(normals.row(nearest).dot(above.transpose()), 0.85) << f;
  }
}

TEST(Bust, TextureCoordinatesAreThoseOfTheIdealBust) {
  const Mesh body = SyntheticHeads(5000).body();
  for (Index v = 0; v < body.positions.rows(); ++v) {
    EXPECT_GT(body.uvs.row(v).minCoeff(), 0);
    EXPECT_LT(body.uvs.row(v).maxCoeff(), 1);
    const Eigen::Vector3d ideal = synth::bust_point(body.uvs.row(v));
    EXPECT_LT((ideal - row3(body.positions, v)).norm(), 0.7) << v;
  }
}

}  // namespace
}  // namespace crowdface
