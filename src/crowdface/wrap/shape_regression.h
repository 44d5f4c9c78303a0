// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/shape_model.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

struct RegressionOptions {
  double local_share = 0.15;  ///< of the heads' variance: only places near each other share it
  double reach_mm = 45;       ///< how near
  /// What heads differ by besides, smooth over the same reach: a few heads span too little. Standard
  /// deviation along each axis.
  double smooth_mm = 1.8;
  double noise_mm = 1, landmark_mm = 3;  ///< of what the scan and the landmarks say
  std::size_t places = 800;              ///< of the skin that are asked for
  std::vector<double> search_mm = {10, 8, 6, 5, 4, 4, 4};  ///< one round each
};

/// The most likely head, given the model and that places all over the skin lie on the scan: Gaussian
/// process regression (Lüthi et al. 2018). The scan says how far it is along its normal, nothing of where
/// along the surface a place belongs: that follows from how heads differ.
/// \param model      of the skin, where the scan stands, in millimetres
/// \param positions  #skin by 3: near the scan already.
Positions regress_shape(const SkinMesh& skin, const ShapeModel& model, const Positions& positions,
                        const ScanSurface& scan, const std::vector<WrapLandmark>& landmarks,
                        const RegressionOptions& options = {});

}  // namespace crowdface
