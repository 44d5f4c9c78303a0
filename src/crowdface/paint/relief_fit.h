// SPDX-License-Identifier: Apache-2.0
// The depths of a mean face, and the comparison of the depths of a surface with the mean face.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace crowdface {

/// The depths of the mean face form a grid. Columns run from side to side, rows from 32 mm above
/// the eyes to 96 mm below the eyes.
inline constexpr int kReliefRows = 17;
/// Number of columns on one side of the face, including the middle column.
inline constexpr int kHalfReliefColumns = 6;
/// Number of columns of the grid, on both sides of the face.
inline constexpr int kReliefColumns = 2 * kHalfReliefColumns - 1;
/// Number of cells of the grid.
inline constexpr int kReliefCells = kReliefRows * kReliefColumns;
/// Distance between neighbouring rows and columns of the grid.
inline constexpr double kReliefSpacingMm = 8;
/// How far the grid's top row lies above the eyes.
inline constexpr double kReliefTopRowHeightMm = 32;
/// Index of the cell that lies between the eyes.
inline constexpr int kCellBetweenEyes = 4 * kReliefColumns + kHalfReliefColumns - 1;

/// Signed sideways distance of a cell from the symmetry plane of the mean face, in mm.
constexpr double cell_lateral_offset_mm(int cell) {
  return kReliefSpacingMm * (cell % kReliefColumns - (kHalfReliefColumns - 1));
}
/// How far a cell lies above the eyes of the mean face, in mm; negative below the eyes.
constexpr double cell_height_mm(int cell) {
  const int row = cell / kReliefColumns;
  return kReliefTopRowHeightMm - kReliefSpacingMm * row;
}
/// Depth of the mean face in a cell of the grid, relative to the tip of the nose; negative behind
/// the tip.
double depth_of_mean_face_mm(int cell);

/// The depth of a grid cell that contains no surface.
inline constexpr double kNoDepth = -std::numeric_limits<double>::infinity();
/// The depth of a surface in each cell of the grid, row by row.
using ReliefDepths = std::array<double, kReliefCells>;

/// Result of comparing the depths of a surface with the mean face. The comparison fits a model to
/// the depths: a weighted sum of a constant, slopes, curvatures and the depths of the mean face.
struct ReliefFit {
  double correlation = -1;  ///< see ReliefMatch::correlation
  double amplitude = 0;     ///< coefficient of the mean face in the fitted model
  /// depth of the fitted model at the point between the eyes, without the model's summand for the
  /// mean face
  double offset = 0;
  /// vertical slope (change of depth per length upwards) of the fitted model at the middle height
  /// of the grid, without the model's summand for the mean face
  double slope_up = 0;
};

/// Fits a model to the depths by least squares. The model is a weighted sum of a constant, slopes,
/// curvatures and the depths of the mean face.
/// \param depths  in mm, scaled to a face of average size; kNoDepth in cells without a surface
ReliefFit fit_relief(ReliefDepths depths);

}  // namespace crowdface
