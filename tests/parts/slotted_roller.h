// SPDX-License-Identifier: Apache-2.0
// Skin that nearly touches skin, as lips do.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface::testing {

/// A roller, open at both ends, with a slot along its front: two walls that face each other.
/// \param gap   between the walls
/// \param step  along the roller
inline Mesh slotted_roller(double gap, double step = 0.5) {
  constexpr int kAround = 60, kWall = 10, kLong = 16;  // quads
  constexpr double kRadius = 5;
  std::vector<std::array<double, 2>> profile;  // y, z
  const double pi = 3.14159265358979323846, front = std::asin(0.05);
  for (int i = 0; i <= kAround; ++i) {
    const double angle = front + (2 * pi - 2 * front) * i / kAround;
    profile.push_back({kRadius * std::sin(angle), kRadius * std::cos(angle)});
  }
  for (int i = 0; i < kWall; ++i) profile.push_back({-gap / 2, 4.9 - 0.5 * i});
  for (int i = kWall; i-- > 0;) profile.push_back({gap / 2, 4.9 - 0.5 * i});

  Mesh mesh;
  const auto around = static_cast<std::uint32_t>(profile.size());
  mesh.topology.vertex_count = around * (kLong + 1);
  mesh.positions.resize(mesh.topology.vertex_count, 3);
  for (std::uint32_t x = 0; x <= kLong; ++x) {
    for (std::uint32_t i = 0; i < around; ++i) {
      mesh.positions.row(x * around + i) << step * (x - kLong / 2.0), profile[i][0], profile[i][1];
      if (x == kLong) continue;
      const std::uint32_t a = x * around + i, b = x * around + (i + 1) % around;
      auto& corners = mesh.topology.corner_vertices;
      corners.insert(corners.end(), {a, a + around, b + around, b});
      mesh.topology.face_offsets.push_back(static_cast<std::uint32_t>(corners.size()));
    }
  }
  return mesh;
}

}  // namespace crowdface::testing
