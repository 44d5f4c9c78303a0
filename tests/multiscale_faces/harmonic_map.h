// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "multiscale_faces/front_patch.h"

namespace crowdface::multiscale {

/// Maps a face to the unit square by a discrete harmonic map (Eck et al. 1995). The border goes
/// around the square by arc length, from corner to corner. Negative cotangent weights would fold
/// triangles; small positive weights replace them, so that no triangle folds (Tutte 1963). A part
/// of the patch that shares only two vertices with the rest collapses to a line. Vertices around
/// holes are not constrained.
/// \param positions  #P by 3: one row per vertex of the patch.
/// \return #P by 2, each in [0, 1].
/// \throws InvalidInput if the system cannot be solved.
TextureCoordinates harmonic_map(const FrontPatch& patch, const Positions& positions);

}  // namespace crowdface::multiscale
