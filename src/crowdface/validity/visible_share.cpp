// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/visible_share.h"

#include <algorithm>

namespace crowdface {
namespace {

/// approximate distance between neighbouring samples on a triangle
constexpr double kSpacingMm = 1;
constexpr int kMaxAlongEdge = 8;  ///< largest number of samples along an edge of a triangle

int points_along_edge(const Corners& corners, double mm_per_unit) {
  const double longest =
      std::max({(corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(),
                (corners[0] - corners[2]).norm()});
  return std::clamp(static_cast<int>(longest * mm_per_unit / kSpacingMm), 1, kMaxAlongEdge);
}

}  // namespace

double ray_margin(const Positions& positions) {
  return 1e-5 * (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
}

double visible_share(const TriangleScene& scene, const Corners& corners, std::uint32_t triangle,
                     double mm_per_unit, std::span<const Eigen::Vector3d> directions,
                     std::span<const std::size_t> viewers,
                     std::span<std::uint32_t> last_occluders) {
  if (viewers.empty()) return 0;
  const int n = points_along_edge(corners, mm_per_unit);
  int shown = 0;
  const auto look_at = [&](int thirds_b, int thirds_c) {
    const double b = thirds_b / (3.0 * n), c = thirds_c / (3.0 * n);
    const Eigen::Vector3d point = (1 - b - c) * corners[0] + b * corners[1] + c * corners[2];
    shown += std::ranges::any_of(viewers, [&](std::size_t viewer) {
      std::uint32_t& other = last_occluders[viewer];
      other = scene.find_any_hit(point, directions[viewer], triangle, other);
      return other == kNoIndex;
    });
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      look_at(3 * i + 1, 3 * j + 1);
      if (i + j < n - 1) look_at(3 * i + 2, 3 * j + 2);
    }
  }
  return static_cast<double>(shown) / (n * n);
}

}  // namespace crowdface
