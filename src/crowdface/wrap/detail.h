// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// Brings a skin that lies near the scan onto it, each vertex along its own normal only, so that
/// nothing slides: relief down to about twice the skin's edges is kept.
/// \param rest       #skin by 3, the template's own: no triangle comes to lie turned over against it.
/// \param positions  #skin by 3, in millimetres, where the scan stands.
/// \param smoothings  where a skin is much finer than what it was bent by: how often normals and offsets are evened
///                   out between neighbours in a round before the others, so that what is coarse is mended as a
///                   whole and no normals cross in creases; else 0.
Positions follow_detail(const SkinMesh& skin, const Positions& rest, const Positions& positions,
                        const ScanSurface& scan, int smoothings);

}  // namespace crowdface
