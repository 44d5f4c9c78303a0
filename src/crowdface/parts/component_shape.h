// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Measured distances from the skin are clamped to this fraction of the skin's extent.
constexpr double kFarFromSkin = 0.05;

/// Geometric properties of a connected component that distinguish skin, eyes and lashes.
struct ComponentShape {
  Index vertex_count = 0;
  Index polygon_count = 0;
  double extent = 0;     ///< diagonal of the bounding box
  double thickness = 0;  ///< shortest side of the bounding box
  /// Perimeter² / (4π · area), where the perimeter is the total length of boundary edges. 0 for a
  /// closed surface, ½ for a hemisphere, 1 for a disc, more for a strip; independent of the number
  /// of vertices.
  double isoperimetric_ratio = 0;
  /// 90th percentile of the vertices' distances from the skin, clamped to kFarFromSkin times the
  /// skin's extent.
  double skin_distance = 0;
  /// centre of the least-squares sphere through the vertices
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;  ///< radius of the least-squares sphere
  /// root mean square distance of the vertices and polygon centres from the least-squares sphere
  double roughness = 0;
};

/// Returns the shapes of all components. The largest component is the skin; its skin_distance is 0.
///
/// \param positions  #V by 3, any unit.
std::vector<ComponentShape> component_shapes(const Topology& topology, const Adjacency& adjacency,
                                             const Components& components,
                                             const Positions& positions);

/// Returns the vertices of each component, ascending.
std::vector<std::vector<std::uint32_t>> vertices_of_components(const Components& components);

/// Returns the index of a vertex in an ascending list, or kNoIndex if it is not in the list.
std::uint32_t index_in_list(std::span<const std::uint32_t> ascending, std::uint32_t vertex);

/// Returns the bounding box of the given vertices (at least one).
Eigen::AlignedBox3d bounding_box(const Positions& positions,
                                 std::span<const std::uint32_t> vertices);
/// Returns the mean position of the given vertices (at least one).
Eigen::Vector3d centre_of(const Positions& positions, std::span<const std::uint32_t> vertices);
/// Returns the root mean square distance of the given vertices (at least one) from a point.
double radius_about(const Eigen::Vector3d& point, const Positions& positions,
                    std::span<const std::uint32_t> vertices);
/// Returns the length of the diagonal of the bounding box of one or more vertices.
double extent_of(const Positions& positions, std::span<const std::uint32_t> vertices);

}  // namespace crowdface
