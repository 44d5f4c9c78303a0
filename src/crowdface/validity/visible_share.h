// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "crowdface/validity/triangle_scene.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {

/// Returns a margin for the boxes of a TriangleScene. The margin is large enough that rounding
/// errors make no ray miss a box.
double ray_margin(const Positions& positions);

/// Returns the fraction of a triangle that at least one of the given viewers can see. The fraction
/// is measured at samples about a millimetre apart, which are the centroids of equal subtriangles.
///
/// \param corners     corners of the triangle.
/// \param triangle    index of the triangle in the scene; a triangle never hides its own samples.
/// \param directions  directions towards all viewers, of any non-zero length.
/// \param viewers     indices into `directions` of the viewers that count.
/// \param last_occluders  one entry per direction, at first kNoIndex; updated: the last result of
///                        TriangleScene::find_any_hit in this direction, which is the guess for the
///                        next ray.
double visible_share(const TriangleScene& scene, const Corners& corners, std::uint32_t triangle,
                     double mm_per_unit, std::span<const Eigen::Vector3d> directions,
                     std::span<const std::size_t> viewers, std::span<std::uint32_t> last_occluders);

}  // namespace crowdface
