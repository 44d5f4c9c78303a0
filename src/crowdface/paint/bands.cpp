// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/bands.h"

#include <algorithm>

#include "crowdface/core/error.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/core/text.h"
#include "crowdface/paint/ears.h"

namespace crowdface {
namespace {

// Lengths are parts of the way from mouth to eyes. Borders between the bands: under the brows, and
// between nose and lips; half as wide to either side as they are soft. Bands are of different people, often
// by a centimetre: where that has less room than four centimetres it is seen as a ridge.
constexpr double kUpperBorder = 1.2, kLowerBorder = 0.24, kSoft = 0.3;
// Ears are painted this far around what stands out; the neck begins this far below chin and ears.
constexpr double kAroundEar = 0.12, kBelowEar = 0.2, kFrontOfEar = 0.08, kEarSoft = 0.12,
                 kBelowChin = 0.12, kNeckSoft = 0.12;

/// How much of the ears each place is.
double ear_share(const EarBox& ears, double face, double side, double height, double front) {
  const double around = kAroundEar * face, soft = kEarSoft * face;
  const auto inside = [&](double from, double to, double x) {
    return smooth_step(from - soft, from + soft, x) * smooth_step(to + soft, to - soft, x);
  };
  return inside(ears.bottom - kBelowEar * face, ears.top + around, height) *
         inside(ears.back - around, ears.front + kFrontOfEar * face, front) *
         smooth_step(ears.inner - 2 * around, ears.inner, side);
}

/// The height below which a place is neck: it rises from under the chin to under the ears.
struct NeckBorder {
  double chin_front, chin, ear_front, ear;
  double at(double front) const {
    const double way = std::max(chin_front - ear_front, 1e-300);
    const double t = std::clamp((front - ear_front) / way, 0.0, 1.0);
    return (1 - t) * std::max(ear, chin) + t * chin;
  }
};

}  // namespace

RegionWeights::Alpha level_bands(const Eigen::VectorXd& heights, double eyes, double mouth) {
  if (!(eyes > mouth)) {
    throw InvalidInput(
        concat("expected eyes above the mouth, found eyes at ", eyes, " and the mouth at ", mouth));
  }
  const double face = eyes - mouth, soft = kSoft * face;
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
                                   const HeadAxes& axes, const FaceMarks& marks,
                                   const std::vector<Band>& bands) {
  const Positions& positions = head.positions;
  const auto column = [&](Band band) {
    return static_cast<Index>(std::ranges::find(bands, band) - bands.begin());
  };
  const auto count = static_cast<Index>(bands.size());
  const Index ear = column(Band::kEars), neck = column(Band::kNeck);
  const bool with_ears = ear < count || neck < count;
  const auto found = with_ears ? find_ears(topology, head, axes, marks) : std::nullopt;
  if (ear < count && !found) throw InvalidInput("no ears stand out at the sides of the head");
  const EarBox ears = found.value_or(EarBox());
  const Eigen::Vector3d side = axes.side();
  Eigen::VectorXd heights(positions.rows());
  double least = marks.chin, middle_front = 0;
  for (Index v = 0; v < positions.rows(); ++v) {
    const Eigen::Vector3d p = row3(positions, v);
    heights[v] = dot3(p, axes.up);
    least = std::min(least, heights[v]);
    middle_front += dot3(p, axes.front) / static_cast<double>(positions.rows());
  }
  if (neck < count && least > marks.chin - 2 * kBelowChin * marks.face()) {
    throw InvalidInput("no neck: the head ends at its chin");
  }
  const double under = kBelowChin * marks.face();
  NeckBorder border{marks.chin_front, marks.chin - under, middle_front, marks.mouth - 2 * under};
  if (found) {
    border.ear_front = ears.front;
    border.ear = ears.bottom - 2 * under;
  }
  const RegionWeights::Alpha level = level_bands(heights, marks.eyes, marks.mouth);
  RegionWeights::Alpha alpha = RegionWeights::Alpha::Zero(positions.rows(), count);
  const double soft = kNeckSoft * marks.face();
  for (Index v = 0; v < positions.rows(); ++v) {
    const Eigen::Vector3d p = row3(positions, v);
    const double front = dot3(p, axes.front);
    double rest = 1;
    if (ear < count) {
      const double away = std::abs(dot3(p, side) - marks.middle);
      alpha(v, ear) = ear_share(ears, marks.face(), away, heights[v], front);
      rest -= alpha(v, ear);
    }
    if (neck < count) {
      const double height = border.at(front);
      alpha(v, neck) = rest * smooth_step(height + soft, height - soft, heights[v]);
      rest -= alpha(v, neck);
    }
    constexpr std::array kLevel = {Band::kBrow, Band::kNose, Band::kMouth};
    for (std::size_t k = 0; k < kLevel.size(); ++k) {
      alpha(v, column(kLevel[k])) = rest * level(v, static_cast<Index>(k));
    }
  }
  return alpha;
}

}  // namespace crowdface
