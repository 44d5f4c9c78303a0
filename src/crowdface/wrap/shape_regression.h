// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/shape_model.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// Settings of `regress_shape`.
struct RegressionOptions {
  /// Fraction of the heads' variance that the model treats as local: correlated only between nearby
  /// points.
  double local_variance_fraction = 0.15;
  double correlation_length_mm = 45;  ///< correlation length of the local variation
  /// The model also has a smooth random deformation whose correlation length is
  /// `correlation_length_mm`. It allows shapes that a few heads do not span. This is its standard
  /// deviation along each axis.
  double smooth_deformation_deviation_mm = 1.8;
  double noise_deviation_mm = 1;  ///< standard deviation of the noise in the scan's positions
  /// Number of vertices of the skin at which displacements are measured.
  std::size_t sample_count = 800;
  /// For each round, the largest distance at which the closest point of the scan is used.
  std::vector<double> search_radii_mm = {10, 8, 6, 5, 4, 4, 4};
};

/// Returns the most likely head, given the model and the observation that points of the skin lie on
/// the scan: Gaussian process regression (Lüthi et al. 2018). The scan constrains positions only
/// along the scan's normals; the model determines positions along the surface.
/// \param model  model of the skin, in the scan's frame, in millimetres
/// \param positions  #skin by 3: an initial fit close to the scan.
Positions regress_shape(const SkinMesh& skin, const ShapeModel& model, const Positions& positions,
                        const ScanSurface& scan, const std::vector<WrapLandmark>& landmarks,
                        const RegressionOptions& options = {});

}  // namespace crowdface
