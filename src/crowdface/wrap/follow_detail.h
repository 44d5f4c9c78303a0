// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// Moves a skin that is already close to the scan exactly onto the scan. Each vertex moves only
/// along its normal, so that the correspondence does not slide along the surface. The result keeps
/// relief down to about twice the skin's edge length.
/// \param rest_positions  #skin by 3, of the template; the function flips no triangle relative to
/// these positions.
/// \param positions  #skin by 3, in millimetres, in the scan's frame.
/// \param smoothing_steps  number of smoothing steps of normals and offsets in a preliminary round.
///                    This round corrects coarse errors that remain if the bending step used a much
///                    coarser skin. 0: no preliminary round.
Positions follow_detail(const SkinMesh& skin, const Positions& rest_positions,
                        const Positions& positions, const ScanSurface& scan, int smoothing_steps);

}  // namespace crowdface
