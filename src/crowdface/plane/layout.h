// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/plane/weights.h"

namespace crowdface {

/// How the heads' anchors are laid out on the plane when the config does not place each by hand.
enum class Layout { kCircle, kGrid, kSimilarity, kManual };

/// Anchors on the unit circle, evenly, counter-clockwise from (1, 0). Rounded to 10⁻⁹, because
/// sines differ between C libraries.
std::vector<PlanePoint> circle_layout(Eigen::Index heads);

/// Anchors row by row on a square grid over [−1, 1]², first row on top. A last row that is not full
/// is centred.
std::vector<PlanePoint> grid_layout(Eigen::Index heads);

/// Anchors whose distances resemble the heads' own: classical multidimensional scaling (Torgerson
/// 1952) to the two strongest directions, scaled to the unit disc, rounded to 10⁻⁹. Heads that are
/// alike lie near each other.
/// \param distances  #heads by #heads, symmetric, zero diagonal, any unit.
std::vector<PlanePoint> similarity_layout(const Eigen::MatrixXd& distances);

/// Corners of the convex hull, counter-clockwise, without collinear points; one or two corners if
/// the points coincide or lie on a line.
std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points);

/// The point of a convex polygon that three uniform numbers in [0, 1) stand for, uniform by area
/// (by length on a segment): `pick` chooses the triangle of the fan, `a` and `b` the place in it.
PlanePoint point_in_polygon(const std::vector<PlanePoint>& polygon, double pick, double a,
                            double b);

}  // namespace crowdface
