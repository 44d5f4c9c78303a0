// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A cube of 65,536 steps a side: what positions are rounded to.
struct PackingFrame {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  double step = 1;

  /// The cube around all heads and a quarter more on each side, for faces that go beyond them.
  /// \param heads  at least one vertex in all.
  static PackingFrame around(std::span<const Positions* const> heads);
};

/// Some vertices of a face as little-endian 16-bit numbers: three a vertex, steps from the frame's low
/// corner (clamped to it), then two a vertex, its unit normal on the octahedron unfolded over a
/// square (Meyer et al. 2010, "On floating-point normal vectors"), 0 … 65,535 for −1 … 1.
/// \param around  of the whole mesh, so that a preview is shaded as smoothly as the mesh itself.
/// \param vertices  rows of `positions`.
/// \param lean    of one of `vertices`, by its place there, with this normal, the one that is to be shown; may be empty.
std::string pack_face(
    const Topology& topology, std::span<const std::uint32_t> vertices, const FacesAround& around,
    const PackingFrame& frame, const Positions& positions,
    const std::function<Eigen::Vector3d(std::size_t, const Eigen::Vector3d&)>& lean = {});

/// The first part of that alone: the positions of some vertices.
/// \param vertices  rows of `positions`.
std::string pack_points(std::span<const std::uint32_t> vertices, const PackingFrame& frame,
                        const Positions& positions);

/// How far a vertex moves: three little-endian 16-bit numbers, steps of the frame.
std::string pack_move(const Eigen::RowVector3d& move, const PackingFrame& frame);

/// Bytes as text (RFC 4648).
std::string base64(std::string_view bytes);

/// Numbers as little-endian bytes.
template <class Number>
std::string little_endian(const std::vector<Number>& numbers) {
  static_assert(std::endian::native == std::endian::little);
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

}  // namespace crowdface
