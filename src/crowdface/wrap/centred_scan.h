// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/shape_fit.h"

namespace crowdface {

/// A scan and its landmarks moved so that the middle of the scan's box is the origin, and rounded to steps of about a
/// millionth of the box. Wrapping makes choices, such as the nearest triangle, that hang on the last digits of numbers,
/// and later choices on those before: where the scan stands is not to decide them.
struct CentredScan {
  Scan scan;
  std::vector<WrapLandmark> landmarks;
  Eigen::Vector3d middle;  ///< in the scan's file
};
CentredScan centred(const Scan& scan, std::vector<WrapLandmark> landmarks);

}  // namespace crowdface
