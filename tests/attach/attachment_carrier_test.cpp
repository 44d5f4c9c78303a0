// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/attachment_carrier.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/rigid_motion.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {
namespace {

constexpr double kUnitsPerMm = 0.1;

struct Mesh {
  Topology topology;
  Positions points;
};

/// Synthetic heads, and what sits on the first.
struct Heads {
  SyntheticHeads synthetic{5000, SyntheticHeads::Parts::kEyesAndTeeth};
  std::vector<Positions> heads;
  std::vector<std::uint32_t> skin;

  Heads() {
    for (const std::uint64_t i : {0, 1, 2, 3}) heads.push_back(synthetic.positions(5, i));
    const Components components = find_components(build_adjacency(synthetic.topology()));
    for (std::uint32_t v = 0; v < components.component_of_vertex.size(); ++v) {
      if (components.component_of_vertex[v] == components.largest()) skin.push_back(v);
    }
  }
  const Topology& topology() const { return synthetic.topology(); }
  FittedSkin fitted() const { return {topology(), heads[0], skin, kUnitsPerMm}; }

  /// The skin above a height, so far off it along its normals.
  Mesh cap(double min_height_cm, double centroid_distance_mm) const {
    const Positions normals = vertex_normals(topology(), heads[0]);
    std::vector<std::uint32_t> rows(static_cast<std::size_t>(topology().vertex_count), kNoIndex);
    Mesh cap;
    std::vector<Eigen::RowVector3d> points;
    for (const std::uint32_t v : skin) {
      if (heads[0](v, 1) < min_height_cm) continue;
      rows[v] = static_cast<std::uint32_t>(points.size());
      points.push_back(heads[0].row(v) + centroid_distance_mm * kUnitsPerMm * normals.row(v));
    }
    cap.points.resize(static_cast<Index>(points.size()), 3);
    for (Index p = 0; p < cap.points.rows(); ++p) {
      cap.points.row(p) = points[static_cast<std::size_t>(p)];
    }
    std::vector<Triangle> triangles;
    for (const Triangle& triangle : triangles_of(topology())) {
      const Triangle own = {rows[triangle[0]], rows[triangle[1]], rows[triangle[2]]};
      if (std::find(own.begin(), own.end(), kNoIndex) == own.end()) triangles.push_back(own);
    }
    cap.topology = topology_of(triangles, cap.points.rows());
    return cap;
  }

  /// A bar before the eyes with an arm along each side of the head: three boxes' corners, joined.
  Mesh glasses() const {
    double side = 0, front = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : skin) {
      if (std::abs(heads[0](v, 1)) > 1) continue;
      side = std::max(side, std::abs(heads[0](v, 0)));
      front = std::max(front, heads[0](v, 2));
    }
    std::vector<Triangle> triangles;
    std::vector<Eigen::RowVector3d> points;
    const auto rod = [&](const Eigen::RowVector3d& from, const Eigen::RowVector3d& to) {
      for (int i = 0; i <= 12; ++i) {
        const auto first = static_cast<std::uint32_t>(points.size());
        const Eigen::RowVector3d at = from + (to - from) * (i / 12.0);
        points.push_back(at + Eigen::RowVector3d(0, 0.1, 0));
        points.push_back(at - Eigen::RowVector3d(0, 0.1, 0));
        if (i == 0) continue;
        triangles.push_back({first - 2, first - 1, first});
        triangles.push_back({first - 1, first + 1, first});
      }
    };
    const double x = side + 0.2, z = front + 0.2;
    rod({-x, 0, z}, {x, 0, z});
    rod({-x, 0, z}, {-x, 0, z - 9});
    rod({x, 0, z}, {x, 0, z - 9});
    Mesh glasses;
    glasses.points.resize(static_cast<Index>(points.size()), 3);
    for (Index p = 0; p < glasses.points.rows(); ++p) {
      glasses.points.row(p) = points[static_cast<std::size_t>(p)];
    }
    glasses.topology = topology_of(triangles, glasses.points.rows());
    return glasses;
  }
};

Positions carried(const FittedSkin& skin, const Mesh& mesh, AttachmentMove move,
                  const Positions& face) {
  return AttachmentCarrier(skin, mesh.topology, mesh.points, move)
      .move_to_face(face, skin.normals(face));
}

RigidMotion some_motion() {
  RigidMotion motion;
  motion.rotation << 0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6;
  motion.scale = 1.1;
  motion.pivot = {1, 2, 3};
  motion.moved_pivot = {-4, 0, 2};
  return motion;
}

Positions moved(const RigidMotion& motion, const Positions& points) {
  Positions result = points;
  for (Index p = 0; p < points.rows(); ++p) {
    result.row(p) = motion.apply(row3(points, p)).transpose();
  }
  return result;
}

/// The gap between a face and each point of what was fitted; infinite far from the skin.
std::vector<double> heights_on(const FittedSkin& skin, const Mesh& fitted, const Positions& face,
                               const Positions& points) {
  const Positions normals = skin.normals(face);
  std::vector<double> heights;
  for (Index p = 0; p < points.rows(); ++p) {
    const PointGrid::NearestVertex nearest = skin.grid().nearest(row3(fitted.points, p));
    const bool far = nearest.distance > 25 * skin.units_per_mm() + 2 * skin.vertex_spacing();
    heights.push_back(
        far ? std::numeric_limits<double>::infinity()
            : skin.nearest_skin(face, normals, nearest.vertex, row3(points, p)).height);
  }
  return heights;
}

/// The share of what was off the skin that lies in it now.
double share_inside(const FittedSkin& skin, const Mesh& fitted, const Positions& face,
                    const Positions& points) {
  const std::vector<double> before = heights_on(skin, fitted, skin.mesh_positions(), fitted.points),
                            heights = heights_on(skin, fitted, face, points);
  double inside = 0, all = 0;
  for (std::size_t p = 0; p < heights.size(); ++p) {
    if (!(before[p] > 0) || !std::isfinite(heights[p])) continue;
    all += 1;
    inside += heights[p] < -1e-6 ? 1 : 0;
  }
  return inside / all;
}

TEST(AttachmentCarrier, LeavesThemOnTheMeshTheyWereFittedTo) {
  const Heads heads;
  const FittedSkin skin = heads.fitted();
  for (const double centroid_distance_mm : {1.0, 8.0, 60.0}) {
    const Mesh cap = heads.cap(2, centroid_distance_mm);
    const Positions bent = carried(skin, cap, AttachmentMove::kBend, heads.heads[0]);
    EXPECT_LT((bent - cap.points).cwiseAbs().maxCoeff(), 1e-9) << centroid_distance_mm;
  }
  const Mesh glasses = heads.glasses();
  const Positions seated = carried(skin, glasses, AttachmentMove::kRigid, heads.heads[0]);
  EXPECT_LT((seated - glasses.points).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(AttachmentCarrier, MovesThemWithAFaceThatIsTurnedMovedAndScaled) {
  const Heads heads;
  const FittedSkin skin = heads.fitted();
  const RigidMotion motion = some_motion();
  const Positions face = moved(motion, heads.heads[0]);
  const Mesh cap = heads.cap(2, 30), glasses = heads.glasses();
  const Positions bent = carried(skin, cap, AttachmentMove::kBend, face);
  EXPECT_LT((bent - moved(motion, cap.points)).cwiseAbs().maxCoeff(), 1e-9);
  const Positions seated = carried(skin, glasses, AttachmentMove::kRigid, face);
  EXPECT_LT((seated - moved(motion, glasses.points)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(AttachmentCarrier, KeepsWhatWasOffTheSkinOffIt) {
  const Heads heads;
  const FittedSkin skin = heads.fitted();
  const Mesh cap = heads.cap(2, 0.2), glasses = heads.glasses();
  const AttachmentCarrier bends(skin, cap.topology, cap.points, AttachmentMove::kBend);
  const AttachmentCarrier seats(skin, glasses.topology, glasses.points, AttachmentMove::kRigid);
  const SmoothBend bare(skin, cap.points);
  double before = 0, after = 0, stiff = 0;
  for (std::size_t h = 1; h < heads.heads.size(); ++h) {
    const Positions& face = heads.heads[h];
    const Positions normals = skin.normals(face);
    before += share_inside(skin, cap, face, bare.bend(face));
    after += share_inside(skin, cap, face, bends.move_to_face(face, normals));
    stiff += share_inside(skin, glasses, face, seats.move_to_face(face, normals));
  }
  EXPECT_GT(before, 0.01) << "nothing to push out: the test tells nothing";
  EXPECT_LT(after / 3, 0.001);
  EXPECT_LT(stiff / 3, 0.01);
}

TEST(AttachmentCarrier, KeepsTheGapOfWhatLiesOnTheSkin) {
  const Heads heads;
  const FittedSkin skin = heads.fitted();
  const Mesh cap = heads.cap(2, 1);
  const AttachmentCarrier carrier(skin, cap.topology, cap.points, AttachmentMove::kBend);
  const Positions normals = skin.normals(heads.heads[1]);
  const std::vector<double> before = heights_on(skin, cap, skin.mesh_positions(), cap.points);
  const std::vector<double> heights =
      heights_on(skin, cap, heads.heads[1], carrier.move_to_face(heads.heads[1], normals));
  std::vector<double> centroid_distance_mm;
  for (std::size_t p = 0; p < heights.size(); ++p) {
    centroid_distance_mm.push_back(std::abs(heights[p] - before[p]) / kUnitsPerMm);
  }
  std::sort(centroid_distance_mm.begin(), centroid_distance_mm.end());
  EXPECT_LT(centroid_distance_mm[centroid_distance_mm.size() * 9 / 10], 0.2);
}

/// What lies far off the skin is moved by all the skin around, not by single faces of it.
TEST(AttachmentCarrier, MovesWhatIsFarOffTheSkinSmoothly) {
  const Heads heads;
  const FittedSkin skin = heads.fitted();
  const Mesh cap = heads.cap(2, 50);
  Positions rough = heads.heads[0];
  for (const std::uint32_t v : heads.skin) rough(v, 1) += v % 2 == 0 ? 0.3 : -0.3;  // 3 mm of noise
  const Positions bent = carried(skin, cap, AttachmentMove::kBend, rough);
  const Positions moves = bent - cap.points;
  double roughest = 0;
  const Adjacency adjacency = build_adjacency(cap.topology);
  for (Index p = 0; p < moves.rows(); ++p) {
    for (const std::uint32_t other : adjacency.items_of(p)) {
      const double step = (row3(moves, p) - row3(moves, other)).norm();
      const double edge = (row3(cap.points, p) - row3(cap.points, other)).norm();
      roughest = std::max(roughest, step / std::max(edge, 0.1));
    }
  }
  EXPECT_LT(roughest, 0.1) << "the skin itself is stretched by more than its edges are long";
}

TEST(AttachmentCarrier, TurnsAndScalesWhatIsRigidAsAWhole) {
  const Heads heads;
  const FittedSkin skin = heads.fitted();
  const Mesh glasses = heads.glasses();
  const Positions seated = carried(skin, glasses, AttachmentMove::kRigid, heads.heads[2]);
  const double scale = (seated.row(0) - seated.row(1)).norm() /
                       (glasses.points.row(0) - glasses.points.row(1)).norm();
  EXPECT_NEAR(scale, 1, 0.2);
  for (Index p = 2; p < seated.rows(); ++p) {
    EXPECT_NEAR((seated.row(p) - seated.row(0)).norm(),
                scale * (glasses.points.row(p) - glasses.points.row(0)).norm(), 1e-9);
  }
}

TEST(AttachmentCarrier, GivesTheSameWithAnyThreads) {
  const Heads heads;
  const auto carry = [&](int threads) {
    const ThreadLimit limit(threads);
    const FittedSkin skin = heads.fitted();
    return carried(skin, heads.cap(0, 5), AttachmentMove::kBend, heads.heads[3]);
  };
  EXPECT_EQ(carry(1), carry(4));
}

}  // namespace
}  // namespace crowdface
