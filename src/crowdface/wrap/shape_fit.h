// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/alignment.h"
#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/shape_model.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// Standard deviation of the position of a manually picked landmark, including the variation
/// between people's faces.
inline constexpr double kPickedErrorMm = 3;

/// A landmark with known positions on both template and scan.
struct WrapLandmark {
  std::string name;
  /// Vertex of the landmark. In the caller's landmarks: index into the template's vertices. During
  /// the wrap: index into the vertices of the template's skin.
  std::uint32_t vertex = 0;
  /// Position of the landmark on the scan.
  Eigen::Vector3d scan_position = Eigen::Vector3d::Zero();
  /// true: the program found the landmark by the shape of the surface; false: the user picked it
  bool is_found_by_program = false;
  /// Uncertainty of `scan_position`: standard deviation along each axis. In the fit, the squared
  /// distance between the landmark's vertex and `scan_position` has the weight 1/error_mm².
  double error_mm = kPickedErrorMm;

  /// The weight of this landmark relative to a picked landmark.
  double weight() const { return kPickedErrorMm * kPickedErrorMm / (error_mm * error_mm); }
};

/// The similarity that best maps a template's landmarks to the scan's, in least squares.
/// \param positions  the landmarks' vertices are rows of this matrix; needs at least three
///                   landmarks
Similarity pose_of_landmarks(const Positions& positions,
                             const std::vector<WrapLandmark>& landmarks);

/// Applies a similarity to a point.
Eigen::Vector3d apply_similarity(const Similarity& similarity, const Eigen::Vector3d& point);

/// The pose of a head in a scan, and the head's coefficients in the shape model.
struct ShapeFit {
  Similarity pose;                ///< similarity from the template's frame to the scan's frame
  Eigen::VectorXd coefficients;   ///< one coefficient per mode, in standard deviations
  double median_distance_mm = 0;  ///< median distance from the visible skin to the scan
};

/// Settings of `fit_shape`.
struct ShapeFitOptions {
  /// For each round, the largest distance at which the closest point of the scan is used.
  std::vector<double> search_radii_mm = {25, 20, 16, 12, 10};
  int steps_per_round = 4;  ///< number of Gauss–Newton steps in each round
  /// Weight of the mean squared distance (mm²) between skin and scan. The fit minimises the
  /// weighted mean plus the sum of the squared coefficients. With a larger weight, the coefficients
  /// may therefore be farther from 0.
  double scan_weight = 7;
  /// The offset of a skin vertex from the scan has two components: along the scan's normal, and
  /// tangential to the scan's surface. This is the weight of the tangential component. The normal
  /// component has weight 1.
  double tangential_weight = 0.1;
  /// Weight of the landmarks relative to the weight of the scan's surface.
  double landmark_weight = 0.2;
};

/// Finds the similarity and the model coefficients that best fit the skin to the scan, by
/// point-to-plane distances (Chen & Medioni 1992) and landmarks. Ignores the farthest fifth of the
/// points.
/// \param model  model of the skin, in millimetres; without modes the function finds only the pose.
/// \param start  initial values.
ShapeFit fit_shape(const SkinMesh& skin, const ShapeModel& model, const ScanSurface& scan,
                   const std::vector<WrapLandmark>& landmarks, const ShapeFit& start,
                   const ShapeFitOptions& options = {});

}  // namespace crowdface
