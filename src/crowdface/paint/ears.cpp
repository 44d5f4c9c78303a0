// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/ears.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace crowdface {
namespace {

// Of the way from eyes to mouth, some 65 mm: how far above the eyes and below the mouth the head's own
// breadth is taken, and how far ears stand out at least.
constexpr double kAbove = 0.9, kBelow = 0.1, kLeastEar = 0.06;
/// What stands out by more than this part of the ear's most is ear.
constexpr double kOfMost = 0.4;
constexpr int kBins = 96;

}  // namespace

std::optional<EarBox> find_ears(const Topology& topology, const HeadShape& head,
                                const HeadAxes& axes, const FaceMarks& marks) {
  const Positions& positions = head.positions;
  const std::vector<bool>& skin = head.skin;
  const double face = marks.face(), low = marks.mouth - kBelow * face;
  const double step = (marks.eyes + kAbove * face - low) / (kBins - 1);
  if (!(step > 0)) return std::nullopt;
  const Eigen::Vector3d side = axes.side();
  const auto breadth_at = [&](const Eigen::Vector3d& p) {
    return std::abs(dot3(p, side) - marks.middle);
  };
  // The head's half breadth at each height, from its edges.
  std::array<double, kBins> breadth{};
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face_corners = topology.face(f);
    if (!skin[face_corners[0]]) continue;
    for (std::size_t c = 0; c < face_corners.size(); ++c) {
      Eigen::Vector3d a = row3(positions, face_corners[c]);
      Eigen::Vector3d b = row3(positions, face_corners[(c + 1) % face_corners.size()]);
      if (dot3(a, axes.up) > dot3(b, axes.up)) std::swap(a, b);
      const double ha = (dot3(a, axes.up) - low) / step, hb = (dot3(b, axes.up) - low) / step;
      if (!(hb >= 0) || !(ha <= kBins - 1)) continue;
      const int last = static_cast<int>(std::floor(std::min<double>(hb, kBins - 1)));
      for (int i = std::max(0, static_cast<int>(std::ceil(ha))); i <= last; ++i) {
        const double t = hb > ha ? (i - ha) / (hb - ha) : 0;
        double& most = breadth[static_cast<std::size_t>(i)];
        most = std::max(most, (1 - t) * breadth_at(a) + t * breadth_at(b));
      }
    }
  }
  const auto head_at = [&](double height) {  // without ears
    const double t = std::clamp((height - low) / (step * (kBins - 1)), 0.0, 1.0);
    return (1 - t) * breadth.front() + t * breadth.back();
  };
  double most = 0;
  int at = 0;
  const auto stands_out = [&](int i) {
    return breadth[static_cast<std::size_t>(i)] - head_at(low + i * step);
  };
  for (int i = 0; i < kBins; ++i) {
    if (stands_out(i) <= most) continue;
    most = stands_out(i);
    at = i;
  }
  if (most < kLeastEar * face) return std::nullopt;
  int bottom = at, top = at;
  while (bottom > 0 && stands_out(bottom - 1) > kOfMost * most) --bottom;
  while (top < kBins - 1 && stands_out(top + 1) > kOfMost * most) ++top;
  EarBox ears{low + bottom * step, low + top * step, std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (Index v = 0; v < positions.rows(); ++v) {
    const Eigen::Vector3d p = row3(positions, v);
    const double height = dot3(p, axes.up), front = dot3(p, axes.front);
    if (!skin[static_cast<std::size_t>(v)] || height < ears.bottom || height > ears.top) continue;
    if (breadth_at(p) - head_at(height) < kOfMost * most) continue;
    ears.back = std::min(ears.back, front);
    ears.front = std::max(ears.front, front);
    ears.inner = std::min(ears.inner, head_at(height));
  }
  if (ears.back > ears.front) return std::nullopt;
  return ears;
}

}  // namespace crowdface
