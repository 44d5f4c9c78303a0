// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/shape_fit.h"

namespace crowdface {

/// A scan and its landmarks, translated so that the centre of the scan's bounding box is the
/// origin, and rounded to about a millionth of the box's size. Without centring and rounding, the
/// result of a wrap would depend on the scan's position: discrete choices, such as the nearest
/// triangle, depend on the last digits of coordinates, and their effects accumulate.
struct CentredScan {
  Scan scan;  ///< the translated and rounded scan
  /// The landmarks with translated and rounded `scan_position`.
  std::vector<WrapLandmark> landmarks;
  /// Centre of the scan's bounding box in the coordinates of the scan file.
  Eigen::Vector3d box_centre;
};
/// Translates and rounds a scan and its landmarks.
CentredScan centre_scan(const Scan& scan, std::vector<WrapLandmark> landmarks);

}  // namespace crowdface
