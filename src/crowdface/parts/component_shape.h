// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Distances to the skin are looked for so far, as a share of the skin's extent: they are told as this
/// where it is farther.
constexpr double kFarFromSkin = 0.05;

/// What a connected component looks like by itself, as far as it tells skin, eyes and lashes apart.
struct ComponentShape {
  Index vertices = 0;
  Index faces = 0;
  double extent = 0;     ///< diagonal of its bounding box
  double thickness = 0;  ///< shortest side of the bounding box
  /// Perimeter² / (4π · area) of its open edges: 0 of a closed surface, ½ of a hemisphere, 1 of a
  /// disc, more of a strip; of any number of vertices.
  double openness = 0;
  /// The farthest that nine in ten of its vertices are from the skin, up to kFarFromSkin.
  double skin_distance = 0;
  /// The sphere nearest to its vertices, and how far they are from it (root mean square).
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
  double roughness = 0;
};

/// The shapes of all components; that of the skin, the largest, has a skin_distance of 0.
/// \param positions  #V by 3, any unit.
std::vector<ComponentShape> component_shapes(const Topology& topology, const Adjacency& adjacency,
                                             const Components& components,
                                             const Positions& positions);

/// The vertices of each component, ascending.
std::vector<std::vector<std::uint32_t>> members_of(const Components& components);

/// The place of a vertex among some that ascend; kNoIndex: it is none of them.
std::uint32_t place_in(std::span<const std::uint32_t> ascending, std::uint32_t vertex);

// Of some vertices, at least one:
Eigen::AlignedBox3d bounding_box(const Positions& positions,
                                 std::span<const std::uint32_t> vertices);
/// Their mean.
Eigen::Vector3d centre_of(const Positions& positions, std::span<const std::uint32_t> vertices);
/// How far they are from a place, the root mean square.
double radius_about(const Eigen::Vector3d& middle, const Positions& positions,
                    std::span<const std::uint32_t> vertices);
/// The diagonal of their bounding box.
double extent_of(const Positions& positions, std::span<const std::uint32_t> vertices);

}  // namespace crowdface
