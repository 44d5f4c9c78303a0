// SPDX-License-Identifier: Apache-2.0
// A head made of simple shapes: a skin with eyes, teeth and lashes as pieces of their own.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface::testing {

/// Collects shapes into one mesh; each is a component, numbered from 0 in the order it was added.
class Shapes {
 public:
  /// A closed ball of quads and, at its poles, triangles.
  Shapes& ball(const Eigen::Vector3d& centre, double radius, int rings = 12) {
    const int around = 2 * rings;
    const auto first = static_cast<std::uint32_t>(points_.size());
    const double pi = 3.14159265358979323846;
    points_.push_back(centre + Eigen::Vector3d(0, radius, 0));
    for (int r = 1; r < rings; ++r) {
      const double polar = pi * r / rings;
      for (int a = 0; a < around; ++a) {
        const double turn = 2 * pi * a / around;
        points_.push_back(centre + radius * Eigen::Vector3d(std::sin(polar) * std::sin(turn),
                                                            std::cos(polar),
                                                            std::sin(polar) * std::cos(turn)));
      }
    }
    points_.push_back(centre - Eigen::Vector3d(0, radius, 0));
    const auto last = static_cast<std::uint32_t>(points_.size() - 1);
    const auto at = [&](int r, int a) {
      return first + 1 + static_cast<std::uint32_t>((r - 1) * around + a % around);
    };
    for (int a = 0; a < around; ++a) {
      face({first, at(1, a), at(1, a + 1)});
      for (int r = 1; r + 1 < rings; ++r) {
        face({at(r, a), at(r + 1, a), at(r + 1, a + 1), at(r, a + 1)});
      }
      face({at(rings - 1, a), last, at(rings - 1, a + 1)});
    }
    return *this;
  }

  /// An open sheet of n by 2 quads from a corner along two edges.
  Shapes& strip(const Eigen::Vector3d& corner, const Eigen::Vector3d& along,
                const Eigen::Vector3d& across, int n = 8) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= 2; ++j) points_.push_back(corner + along * i / n + across * j / 2);
    }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < 2; ++j) {
        const auto a = first + static_cast<std::uint32_t>(3 * i + j);
        face({a, a + 3, a + 4, a + 1});
      }
    }
    return *this;
  }

  /// A closed box.
  Shapes& box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < 8; ++i) {
      points_.emplace_back((i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                           (i & 4U) != 0 ? high.z() : low.z());
    }
    constexpr std::uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& s : sides) face({first + s[0], first + s[1], first + s[2], first + s[3]});
    return *this;
  }

  /// A closed tetrahedron, a corner and the three beside it along the axes.
  Shapes& tetrahedron(const Eigen::Vector3d& corner, double size) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    points_.push_back(corner);
    for (Index c = 0; c < 3; ++c) points_.push_back(corner + size * Eigen::Vector3d::Unit(c));
    constexpr std::uint32_t sides[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    for (const auto& s : sides) face({first + s[0], first + s[1], first + s[2]});
    return *this;
  }

  Shapes& vertex(const Eigen::Vector3d& point) {
    points_.push_back(point);
    return *this;
  }

  Mesh mesh() const {
    Mesh mesh;
    mesh.topology = topology_;
    mesh.topology.vertex_count = static_cast<Index>(points_.size());
    mesh.positions.resize(mesh.topology.vertex_count, 3);
    for (Index i = 0; i < mesh.positions.rows(); ++i) {
      mesh.positions.row(i) = points_[static_cast<std::size_t>(i)].transpose();
    }
    return mesh;
  }

 private:
  void face(std::initializer_list<std::uint32_t> corners) {
    auto& all = topology_.corner_vertices;
    all.insert(all.end(), corners);
    topology_.face_offsets.push_back(static_cast<std::uint32_t>(all.size()));
  }

  std::vector<Eigen::Vector3d> points_;
  Topology topology_;
};

/// Components of the head below.
enum HeadComponent : std::uint32_t {
  kSkinBall,
  kLeftEye,
  kLeftIris,
  kRightEye,
  kFirstTooth,
  kSecondTooth,
  kLash,
  kLoneVertex
};

/// A ball of 10 cm for the skin, eyes half out of it, teeth inside behind its front, a lash on it.
inline Mesh simple_head() {
  return Shapes()
      .ball({0, 0, 0}, 10, 32)
      .ball({3, 3, 8}, 1.25)
      .ball({3, 3, 8.2}, 1)
      .ball({-3, 3, 8}, 1.25)
      .box({-1, -3.5, 8.2}, {-0.05, -2.5, 8.7})
      .box({0.05, -3.5, 8.2}, {1, -2.5, 8.7})
      .strip({1.5, 5.2, 8.4}, {1.5, -0.4, -0.3}, {0, 0.3, 0.8})
      .vertex({20, 0, 0})
      .mesh();
}

/// x ↦ scale · R x + t with R about a slanted axis.
inline Positions moved(const Positions& positions, double angle, double scale,
                       const Eigen::RowVector3d& shift) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -0.5).normalized();
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const Eigen::Matrix3d turn =
      Eigen::Matrix3d::Identity() + std::sin(angle) * cross + (1 - std::cos(angle)) * cross * cross;
  return (scale * positions * turn.transpose()).rowwise() + shift;
}

}  // namespace crowdface::testing
