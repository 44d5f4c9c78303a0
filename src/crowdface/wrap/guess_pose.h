// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/core/units.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// Which way the head on a scan looks, where no landmarks tell: unit vectors in the scan's frame.
struct PoseHint {
  Eigen::Vector3d up, front;
};

/// The similarity from a template to a scan of which only that much is known: of several sizes and
/// places the one from which closest points come nearest.
Similarity guess_pose(const SkinMesh& skin, const Positions& rest, const HeadAxes& axes,
                      const ScanSurface& scan, const PoseHint& hint);

/// The axes along which a scan stands that fits clearly better than the one that was said; nothing if none does.
struct ScanBearing {
  Axis up, front;
};
std::optional<ScanBearing> better_bearing(const SkinMesh& skin, const Positions& rest,
                                          const HeadAxes& axes, const ScanSurface& scan,
                                          const PoseHint& said);

}  // namespace crowdface
