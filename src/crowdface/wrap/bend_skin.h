// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// Settings of `bend_skin`. Each round has a smaller stiffness than the previous round.
struct BendOptions {
  /// Stiffness of each round, given as a wavelength. The round suppresses variations of the
  /// displacement with shorter wavelengths. The effect does not depend on the mesh resolution.
  std::vector<double> wavelengths_mm = {60, 40, 25, 16, 10, 7, 5, 3.5, 2.5};
  /// Weight of the offsets from the skin to the scan along the surface, in the first and in the
  /// last round. Offsets along the normal have weight 1.
  double first_round_tangential_weight = 0.2, last_round_tangential_weight = 0.8;
  /// Weight of the landmarks in the first and in the last round.
  double first_round_landmark_weight = 1, last_round_landmark_weight = 0.3;
};

/// Two vertices of the skin that keep their difference, such as two vertices of closed lips.
struct TiedVertices {
  std::array<std::uint32_t, 2> vertices;
  Eigen::Vector3d difference;  ///< wanted position of the second vertex minus that of the first
};

/// Deforms a skin onto a scan by non-rigid iterated closest points (Amberg et al. 2007), with a
/// bilaplacian of the displacements as regulariser.
/// \param base  #skin by 3, in millimetres, in the scan's frame: the shape before deformation.
/// \param ties  pairs of vertices that keep their difference, whatever the scan shows there.
/// \return #skin by 3
Positions bend_skin(const SkinMesh& skin, const Positions& base, const ScanSurface& scan,
                    const std::vector<WrapLandmark>& landmarks,
                    const std::vector<TiedVertices>& ties, const BendOptions& options);

}  // namespace crowdface
