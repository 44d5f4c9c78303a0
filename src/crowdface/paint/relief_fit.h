// SPDX-License-Identifier: Apache-2.0
// The depths of a mean face, and how the depths of a surface compare with them.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace crowdface {

/// The mean face has a depth at each cell of a grid: columns from side to side, rows from 32 mm above the eyes to 96 mm below.
inline constexpr int kReliefRows = 17, kHalfReliefColumns = 6,
                     kReliefColumns = 2 * kHalfReliefColumns - 1,
                     kReliefCells = kReliefRows * kReliefColumns;
inline constexpr double kReliefSpacingMm = 8, kReliefTopMm = 32;
inline constexpr int kBetweenEyes = 4 * kReliefColumns + kHalfReliefColumns - 1;  ///< a cell

/// Where a cell lies, from the middle of the face to the side and from the eyes up.
constexpr double across_mm(int cell) {
  return kReliefSpacingMm * (cell % kReliefColumns - (kHalfReliefColumns - 1));
}
constexpr double height_mm(int cell) {
  return kReliefTopMm - kReliefSpacingMm * (cell / kReliefColumns);
}
/// How far the mean face lies in front there, negative: behind the tip of the nose.
double relief_mm(int cell);

inline constexpr double kNoDepth = -std::numeric_limits<double>::infinity();
using ReliefDepths = std::array<double, kReliefCells>;

/// How depths compare with the mean face.
struct ReliefFit {
  double agreement = -1;
  double amplitude = 0;  ///< of the relief, 1 for the mean face
  double offset = 0;     ///< depth between the eyes less the relief's
  double slope_up = 0;   ///< of the depths beneath the relief
};

/// Least squares of depths by an offset, slopes, curvatures and the mean face.
/// \param depths  in mm, of a face of mean size; cells without a surface are kNoDepth
ReliefFit fit_relief(ReliefDepths depths);

}  // namespace crowdface
