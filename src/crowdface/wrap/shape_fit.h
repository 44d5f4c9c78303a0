// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/mesh/alignment.h"
#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/shape_model.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// One place marked on both.
struct WrapLandmark {
  std::string name;
  std::uint32_t vertex = 0;  ///< row of the skin (of the template, before wrapping)
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< on the scan
  bool by_shape = false;                            ///< found by the program, picked by nobody
};

/// The similarity that carries a template's landmarks nearest to the scan's.
/// \param positions  of what the landmarks' rows are of; at least three landmarks
Similarity pose_of_landmarks(const Positions& positions,
                             const std::vector<WrapLandmark>& landmarks);

/// A point after a similarity.
Eigen::Vector3d carried(const Similarity& by, const Eigen::Vector3d& point);

/// Where a head stands on a scan, and which of the model's heads it is.
struct ShapeFit {
  Similarity pose;               ///< from the template to the scan
  Eigen::VectorXd coefficients;  ///< #modes, in standard deviations
  double residual = 0;           ///< median distance from the visible skin to the scan, mm
};

struct ShapeFitOptions {
  std::vector<double> reach_mm = {25, 20, 16, 12, 10};  ///< one round each
  int steps = 4;                                        ///< in each round
  /// How many independent measurements of 1 mm error a whole scan amounts to: the more, the less the
  /// coefficients are held near 0.
  double measurements = 7;
  double tangential = 0.1;       ///< weight along the surface, against 1 across it
  double landmark_weight = 0.2;  ///< share of the landmarks against the surface
};

/// The similarity, and the coefficients of the model, that carry the skin nearest to the scan: point
/// to plane (Chen & Medioni 1992), farthest fifth left out, landmarks along.
/// \param model  of the skin, in millimetres; without modes only the pose is found.
/// \param start  where to begin.
ShapeFit fit_shape(const SkinMesh& skin, const ShapeModel& model, const ScanSurface& scan,
                   const std::vector<WrapLandmark>& landmarks, const ShapeFit& start,
                   const ShapeFitOptions& options = {});

}  // namespace crowdface
