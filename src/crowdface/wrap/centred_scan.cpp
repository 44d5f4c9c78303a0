// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/centred_scan.h"

#include <cmath>
#include <utility>

namespace crowdface {

CentredScan centre_scan(const Scan& scan, std::vector<WrapLandmark> landmarks) {
  constexpr int kBits = 20;
  CentredScan result{scan, std::move(landmarks), Eigen::Vector3d::Zero()};
  Positions& positions = result.scan.positions;
  if (positions.rows() == 0) return result;
  const Eigen::RowVector3d low = positions.colwise().minCoeff(),
                           high = positions.colwise().maxCoeff();
  const double size = (high - low).maxCoeff();
  if (!(size > 0)) return result;
  const double step = std::ldexp(1.0, std::ilogb(size) - kBits);
  const Eigen::RowVector3d middle = (low + high) / 2;
  const auto moved = [&](const auto& rows) -> Positions {
    return ((rows.rowwise() - middle) / step).array().round().matrix() * step;
  };
  positions = moved(positions);
  for (WrapLandmark& landmark : result.landmarks) {
    landmark.scan_position =
        moved(Positions(landmark.scan_position.transpose())).row(0).transpose();
  }
  result.box_centre = middle.transpose();
  return result;
}

}  // namespace crowdface
