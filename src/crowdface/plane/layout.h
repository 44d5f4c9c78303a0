// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/plane/weights.h"

namespace crowdface {

/// The layout of the heads' anchors on the weight plane. With kManual, the config gives each
/// anchor.
enum class Layout { kCircle, kGrid, kSimilarity, kManual };

/// Places the anchors evenly on the unit circle, counter-clockwise from (1, 0). The coordinates are
/// rounded to 10⁻⁹, because sines differ between C libraries.
std::vector<PlanePoint> circle_layout(Eigen::Index heads);

/// Places the anchors row by row on a square grid over [−1, 1]², the first row on top. A partial
/// last row is centred.
std::vector<PlanePoint> grid_layout(Eigen::Index heads);

/// Places the anchors so that their distances approximate the given distances between heads, by
/// classical multidimensional scaling (Torgerson 1952) with the two largest components. The result
/// is scaled to the unit disc and rounded to 10⁻⁹.
/// \param distances  #heads by #heads, symmetric, zero diagonal, any unit.
std::vector<PlanePoint> similarity_layout(const Eigen::MatrixXd& distances);

/// Corners of the convex hull, counter-clockwise, without collinear points. There are two corners
/// if all points lie on a line, and one if all points coincide.
std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points);

/// Maps three uniform random numbers to a point distributed uniformly by area in a convex polygon
/// (by length on a segment).
/// \param pick  in [0, 1): selects the triangle of the polygon's fan.
/// \param a, b  in [0, 1): select the point in that triangle.
PlanePoint sample_polygon(const std::vector<PlanePoint>& polygon, double pick, double a, double b);

}  // namespace crowdface
