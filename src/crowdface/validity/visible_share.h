// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "crowdface/validity/triangle_scene.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {

/// Returns a margin for the boxes of a TriangleScene, so that no ray misses a box through rounding.
double ray_margin(const Positions& positions);

/// Returns the fraction of a triangle that is visible to any of the given viewers, sampled at points
/// about a millimetre apart: the centroids of equal subtriangles.
/// \param at          corners of the triangle.
/// \param triangle    index of the triangle in the scene; a triangle never hides its own samples.
/// \param directions  directions towards viewers, of any non-zero length.
/// \param viewers     indices into `directions`: the viewers that count.
/// \param last_occluders  #directions: the last occluder found for each viewer; the next ray to the
///                        viewer tests it first.
double visible_share(const TriangleScene& scene, const Corners& at, std::uint32_t triangle,
                     double mm_per_unit, std::span<const Eigen::Vector3d> directions,
                     std::span<const std::size_t> viewers, std::span<std::uint32_t> last_occluders);

}  // namespace crowdface
