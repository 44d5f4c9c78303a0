// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "crowdface/validity/triangle_scene.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {

/// Returns a margin for a scene's boxes, so that no ray misses a box through rounding.
double ray_margin(const Positions& positions);

/// Returns the fraction of a triangle that is visible to any of the given viewers, sampled at points
/// about a millimetre apart: the centroids of equal subtriangles.
/// \param triangle    number of the triangle in the scene, which does not hide itself.
/// \param directions  towards viewers, of any non-zero length.
/// \param viewers     indices of `directions`.
/// \param in_the_way  #directions: the last occluder found for each viewer, tested first for the
///                    next ray.
double visible_share(const TriangleScene& scene, const Corners& at, std::uint32_t triangle,
                     double mm_per_unit, std::span<const Eigen::Vector3d> directions,
                     std::span<const std::size_t> viewers, std::span<std::uint32_t> in_the_way);

}  // namespace crowdface
