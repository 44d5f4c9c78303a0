// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/mask_bands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "crowdface/core/error.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/core/text.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {
namespace {

// Lengths are fractions of the height of the eyes above the mouth, about 65 mm. The upper border
// runs under the brows, the lower border between nose and lips. The transition between two regions
// extends by kHalfTransition to both sides of their border, so that the transition is about four
// centimetres wide. Adjacent regions come from different people, whose surfaces are often a
// centimetre apart. A narrower transition would therefore be visible as a ridge.
constexpr double kUpperBorder = 1.2, kLowerBorder = 0.24, kHalfTransition = 0.3;
// Fractions of the height of the eyes above the mouth. kAroundEar: distance from an ear at which
// the transition to the other regions begins. kBelowChin: distance of the neck's border below the
// chin. kMinNeck: smallest length of a neck.
constexpr double kAroundEar = 0.1, kBelowChin = 0.3, kMinNeck = 0.24;

// Fractions of the height of the eyes above the mouth. The search range for ears extends from
// kSearchBelowMouth below the mouth to kSearchAboveEyes above the eyes. kMinEarProtrusion is the
// smallest distance by which an ear protrudes from the head.
constexpr double kSearchAboveEyes = 0.9, kSearchBelowMouth = 0.1, kMinEarProtrusion = 0.06;
/// The vertical range of an ear consists of the heights at which the ear protrudes by more than
/// this fraction of its maximum protrusion.
constexpr double kMinProtrusionFraction = 0.4;
constexpr int kHeightCount = 96;

/// The border below which the neck begins. Its height is interpolated between a point below the
/// chin and a point below the ears.
struct NeckBorder {
  double chin_front, chin, ear_front, ear;
  double at(double front) const {
    const double way = std::max(chin_front - ear_front, 1e-300);
    const double t = std::clamp((front - ear_front) / way, 0.0, 1.0);
    return (1 - t) * std::max(ear, chin) + t * chin;
  }
};

}  // namespace

std::optional<Ears> find_ears(const Topology& topology, const HeadShape& head,
                              const FaceMarks& marks) {
  const HeadAxes& axes = marks.axes;
  const Positions& positions = head.positions;
  const std::vector<bool>& skin = head.is_skin;
  const double face = marks.eye_to_mouth(), low = marks.mouth_height - kSearchBelowMouth * face;
  const double step = (marks.eyes_height + kSearchAboveEyes * face - low) / (kHeightCount - 1);
  if (!(step > 0)) return std::nullopt;
  const Eigen::Vector3d side = axes.side();
  const auto breadth_at = [&](const Eigen::Vector3d& p) {
    return std::abs(p.dot(side) - marks.symmetry_offset);
  };
  // Half breadth of the head at each of kHeightCount heights, measured where the edges of the
  // skin mesh cross this height.
  std::array<double, kHeightCount> breadth{};
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face_corners = topology.face(f);
    if (!skin[face_corners[0]]) continue;
    for (std::size_t c = 0; c < face_corners.size(); ++c) {
      Eigen::Vector3d a = row3(positions, face_corners[c]);
      Eigen::Vector3d b = row3(positions, face_corners[(c + 1) % face_corners.size()]);
      if (a.dot(axes.up) > b.dot(axes.up)) std::swap(a, b);
      const double ha = (a.dot(axes.up) - low) / step, hb = (b.dot(axes.up) - low) / step;
      if (!(hb >= 0) || !(ha <= kHeightCount - 1)) continue;
      const int last = static_cast<int>(std::floor(std::min<double>(hb, kHeightCount - 1)));
      for (int i = std::max(0, static_cast<int>(std::ceil(ha))); i <= last; ++i) {
        const double t = hb > ha ? (i - ha) / (hb - ha) : 0;
        double& most = breadth[static_cast<std::size_t>(i)];
        most = std::max(most, (1 - t) * breadth_at(a) + t * breadth_at(b));
      }
    }
  }
  const auto head_at = [&](double height) {  // half breadth without ears
    const double t = std::clamp((height - low) / (step * (kHeightCount - 1)), 0.0, 1.0);
    return (1 - t) * breadth.front() + t * breadth.back();
  };
  // Find the height at which the ears protrude most.
  double most = 0;
  int at = 0;
  const auto stands_out = [&](int i) {
    return breadth[static_cast<std::size_t>(i)] - head_at(low + i * step);
  };
  for (int i = 0; i < kHeightCount; ++i) {
    if (stands_out(i) <= most) continue;
    most = stands_out(i);
    at = i;
  }
  if (most < kMinEarProtrusion * face) return std::nullopt;
  // Find the range of heights around `at` in which the ears protrude by more than the fraction
  // kMinProtrusionFraction of their maximum protrusion.
  int bottom = at, top = at;
  while (bottom > 0 && stands_out(bottom - 1) > kMinProtrusionFraction * most) --bottom;
  while (top < kHeightCount - 1 && stands_out(top + 1) > kMinProtrusionFraction * most) ++top;
  Ears ears{low + bottom * step,
            low + top * step,
            std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity(),
            {}};
  // The ears consist of the protruding skin vertices between the heights ears.bottom and ears.top.
  for (Index v = 0; v < positions.rows(); ++v) {
    const Eigen::Vector3d p = row3(positions, v);
    const double height = p.dot(axes.up), front = p.dot(axes.front);
    if (!skin[static_cast<std::size_t>(v)] || height < ears.bottom || height > ears.top) continue;
    if (breadth_at(p) - head_at(height) < kMinProtrusionFraction * most) continue;
    ears.back = std::min(ears.back, front);
    ears.front = std::max(ears.front, front);
    ears.vertices.push_back(static_cast<std::uint32_t>(v));
  }
  if (ears.vertices.empty()) return std::nullopt;
  return ears;
}

RegionWeights::Alpha horizontal_bands(const Eigen::VectorXd& heights, double eyes, double mouth) {
  if (!(eyes > mouth)) {
    throw InvalidInput(
        concat("expected eyes above the mouth, found eyes at ", eyes, " and the mouth at ", mouth));
  }
  const double face = eyes - mouth, soft = kHalfTransition * face;
  const double upper = mouth + kUpperBorder * face, lower = mouth + kLowerBorder * face;
  RegionWeights::Alpha alpha(heights.size(), 3);
  for (Index v = 0; v < heights.size(); ++v) {
    const double top = smooth_step(upper - soft, upper + soft, heights[v]);
    const double bottom = smooth_step(lower + soft, lower - soft, heights[v]);
    alpha.row(v) << top, 1 - top - bottom, bottom;
  }
  return alpha;
}

RegionWeights::Alpha propose_bands(const Topology& topology, const HeadShape& head,
                                   const FaceMarks& marks, const std::vector<MaskBand>& bands) {
  const HeadAxes& axes = marks.axes;
  const Positions& positions = head.positions;
  const auto column = [&](MaskBand band) {
    return static_cast<Index>(std::ranges::find(bands, band) - bands.begin());
  };
  const auto count = static_cast<Index>(bands.size());
  const Index ear = column(MaskBand::kEars), neck = column(MaskBand::kNeck);
  const bool with_ears = ear < count || neck < count;
  const auto found = with_ears ? find_ears(topology, head, marks) : std::nullopt;
  if (ear < count && !found) throw InvalidInput("no ears were found at the sides of the head");
  Eigen::VectorXd heights(positions.rows());
  double least = marks.chin_height, middle_front = 0;
  for (Index v = 0; v < positions.rows(); ++v) {
    const Eigen::Vector3d p = row3(positions, v);
    heights[v] = p.dot(axes.up);
    least = std::min(least, heights[v]);
    middle_front += p.dot(axes.front) / static_cast<double>(positions.rows());
  }
  const double face = marks.eye_to_mouth(), soft = kHalfTransition * face;
  if (neck < count && least > marks.chin_height - kMinNeck * face) {
    throw InvalidInput("no neck: the head ends at its chin");
  }
  NeckBorder border{marks.chin_front, marks.chin_height - kBelowChin * face, middle_front,
                    marks.mouth_height - kBelowChin * face};
  if (found) {
    border.ear_front = found->front;
    border.ear = found->bottom - kBelowChin * face;
  }
  std::optional<PointGrid> ears;
  if (ear < count) ears.emplace(positions, found->vertices);
  const RegionWeights::Alpha level =
      horizontal_bands(heights, marks.eyes_height, marks.mouth_height);
  RegionWeights::Alpha alpha = RegionWeights::Alpha::Zero(positions.rows(), count);
  for (Index v = 0; v < positions.rows(); ++v) {
    const Eigen::Vector3d p = row3(positions, v);
    const double front = p.dot(axes.front);
    double rest = 1;
    if (ears) {
      const double far = kAroundEar * face + 2 * soft;
      const PointGrid::NearestVertex nearest = ears->nearest(p, far);
      alpha(v, ear) =
          nearest.vertex == kNoIndex ? 0 : smooth_step(far, kAroundEar * face, nearest.distance);
      rest -= alpha(v, ear);
    }
    if (neck < count) {
      const double height = border.at(front);
      alpha(v, neck) = rest * smooth_step(height + soft, height - soft, heights[v]);
      rest -= alpha(v, neck);
    }
    constexpr std::array kLevel = {MaskBand::kBrow, MaskBand::kNose, MaskBand::kMouth};
    for (std::size_t k = 0; k < kLevel.size(); ++k) {
      alpha(v, column(kLevel[k])) = rest * level(v, static_cast<Index>(k));
    }
  }
  return alpha;
}

}  // namespace crowdface
