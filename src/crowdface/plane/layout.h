// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/plane/weights.h"

namespace crowdface {

/// How the heads' anchors are placed on the weight plane. With kManual, the config gives the
/// position of each anchor.
enum class Layout { kCircle, kGrid, kSimilarity, kManual };

/// Places the anchors at equal distances on the unit circle, counter-clockwise from (1, 0). The
/// coordinates are rounded to 10⁻⁹, because the results of sine functions differ between C
/// libraries.
std::vector<PlanePoint> circle_layout(Eigen::Index head_count);

/// Places the anchors row by row on a square grid over [−1, 1]². The first row is at the top. If
/// the last row is not full, it is centred.
std::vector<PlanePoint> grid_layout(Eigen::Index head_count);

/// Places the anchors so that the distances between anchors approximate the given distances between
/// heads, by classical multidimensional scaling (Torgerson 1952) with the two largest components.
/// The result is scaled to fit the unit disc and rounded to 10⁻⁹.
///
/// \param distances  #heads by #heads, symmetric, with a diagonal of zeros, in any unit.
std::vector<PlanePoint> similarity_layout(const Eigen::MatrixXd& distances);

/// Returns the corners of the convex hull, counter-clockwise, without collinear points. If all
/// points lie on a line, there are two corners; if all points coincide, one.
std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points);

/// Maps three uniform random numbers to a point of a convex polygon. The point is distributed
/// uniformly by area or, if the polygon is a segment, by length.
///
/// \param pick  in [0, 1): selects one triangle of the fan into which the polygon is divided.
/// \param a, b  in [0, 1): select the point in this triangle.
PlanePoint sample_polygon(const std::vector<PlanePoint>& polygon, double pick, double a, double b);

}  // namespace crowdface
