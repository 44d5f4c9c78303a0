// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

namespace crowdface {

/// A point in a triangle of a polygon's fan. The triangle's corners are the polygon's corners 0,
/// `second_corner` and `second_corner` + 1. The point is corner 0, plus s times the vector from
/// corner 0 to the second corner, plus t times the vector from corner 0 to the third corner.
struct PolygonSample {
  std::size_t second_corner = 1;  ///< number of the triangle's second corner in the polygon
  /// factors on the vectors from corner 0 to the second corner (s) and to the third corner (t); not
  /// negative; s + t is at most 1
  double s = 0, t = 0;
};

/// A sample point in a polygon: point `number` of a low-discrepancy sequence in the unit square
/// (Roberts 2018), mapped into one triangle of the polygon's fan.
/// \param corners  number of corners of the polygon, at least three
inline PolygonSample polygon_sample(std::size_t number, std::size_t corners) {
  const auto n = static_cast<double>(number);
  const double s = std::fmod(0.5 + 0.7548776662466927 * n, 1.0);
  const double t = std::fmod(0.5 + 0.5698402909980532 * n, 1.0);
  const std::size_t second = 1 + number % (corners - 2);
  return s + t > 1 ? PolygonSample{second, 1 - s, 1 - t} : PolygonSample{second, s, t};
}

}  // namespace crowdface
