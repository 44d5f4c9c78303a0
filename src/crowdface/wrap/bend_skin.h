// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

struct BendOptions {
  /// Stiffness of each round as a length: shorter waves than this are kept out of the displacements,
  /// whatever the resolution.
  std::vector<double> stiffness_mm = {60, 40, 25, 16, 10, 7, 5, 3.5, 2.5};
  /// Weight along the surface, against 1 across it, in the first and in the last round.
  double tangential_first = 0.2, tangential_last = 0.8;
  double landmarks_first = 1, landmarks_last = 0.3;
};

/// Bends a skin onto a scan: non-rigid iterated closest points (Amberg et al. 2007) with a bilaplacian
/// of the displacements, whose stiffness is a length.
/// \param base   #skin by 3, in millimetres, where the scan stands: the shape that is bent.
/// \return       #skin by 3
Positions bend_skin(const SkinMesh& skin, const Positions& base, const ScanSurface& scan,
                    const std::vector<WrapLandmark>& landmarks, const BendOptions& options);

}  // namespace crowdface
