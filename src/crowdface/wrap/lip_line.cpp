// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/lip_line.h"

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/vector3.h"
#include "crowdface/render/ray_scene.h"
#include "crowdface/wrap/scan_surface.h"

namespace crowdface {
namespace {

/// The skin beside a crease is measured this far above and this far below the crease, in mm.
constexpr double kHalfWidthMm = 2.5;
constexpr double kStepMm = 0.5;      ///< distance between neighbouring rays of a profile
constexpr int kHalfWidthSteps = 5;   ///< kHalfWidthMm / kStepMm
constexpr double kColumnStepMm = 1;  ///< distance between profiles
constexpr int kColumnsPerSide = 15;

/// Vertical profiles of a surface near a mouth, seen from the front.
class Profiles {
 public:
  /// \param middle  the middle of the mouth; the class ignores triangles far from it
  Profiles(const Positions& positions, const std::vector<Triangle>& triangles,
           const Eigen::Vector3d& middle, const HeadAxes& axes)
      : middle_(middle), axes_(axes) {
    constexpr double kNearMm = 60;
    for (const Triangle& t : triangles) {
      if ((row3(positions, t[0]) - middle).cwiseAbs().maxCoeff() < kNearMm) triangles_.push_back(t);
    }
    quads_ = quads_of(triangles_);
    scene_.emplace(device_, points_around(positions, middle), quads_);
  }

  static constexpr double kFarBehind = -1000;  ///< depth where no surface is visible
  struct Hit {
    double depth = kFarBehind;  ///< along the front axis, in mm
    SurfacePoint point;
  };
  /// Returns the foremost points at `count` heights that are kStepMm apart.
  /// \param across, up  lateral position and lowest height, relative to the middle of the mouth
  std::vector<Hit> trace(double across, double up, int count) const {
    constexpr double kAheadMm = 200;
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d origin =
          across * axes_.side() + (up + i * kStepMm) * axes_.up + kAheadMm * axes_.front;
      rays.push_back({origin.cast<float>(), (-axes_.front).cast<float>()});
    }
    std::vector<Hit> hits;
    for (const auto& found : scene_->nearest_hits(rays)) {
      Hit& hit = hits.emplace_back();
      if (!found) continue;
      hit.depth = kAheadMm - static_cast<double>(found->distance);
      const double u = found->u, v = found->v;
      hit.point.corners = triangles_[found->primitive];
      hit.point.barycentric = {1 - u - v, u, v};
    }
    return hits;
  }

  /// Depths of a crease at the inner heights of a profile: how far the skin kHalfWidthMm above and
  /// below both protrude. Not negative.
  static std::vector<double> hollows(const std::vector<Hit>& profile) {
    constexpr double kMaxMm = 2.5;
    std::vector<double> depths;
    for (std::size_t i = kHalfWidthSteps; i + kHalfWidthSteps < profile.size(); ++i) {
      const double beside =
          std::min(profile[i - kHalfWidthSteps].depth, profile[i + kHalfWidthSteps].depth);
      depths.push_back(std::clamp(beside - profile[i].depth, 0.0, kMaxMm));
    }
    return depths;
  }

  /// Returns the height in mm of the highest gap that the profile crosses, such as an open mouth. In
  /// a gap higher than 2 kHalfWidthMm, `hollows` returns 0.
  static double gap_height(const std::vector<Hit>& profile) {
    constexpr double kGapDepthMm = 8;
    constexpr std::size_t kReach = 20;  // steps
    int height = 0, highest = 0;        // of the gap so far, and of the highest gap, in steps
    for (std::size_t i = kReach; i + kReach < profile.size(); ++i) {
      double below = kFarBehind, above = kFarBehind;
      for (std::size_t k = 1; k <= kReach; ++k) {
        below = std::max(below, profile[i - k].depth);
        above = std::max(above, profile[i + k].depth);
      }
      height = std::min(below, above) - profile[i].depth > kGapDepthMm ? height + 1 : 0;
      highest = std::max(highest, height);
    }
    return highest * kStepMm;
  }

 private:
  Eigen::Vector3d middle_;
  HeadAxes axes_;
  std::vector<Triangle> triangles_;
  std::vector<Quad> quads_;
  RayDevice device_;
  std::optional<RayScene> scene_;
};

}  // namespace

LipLine find_lip_line(const WrapTemplate& wrap_template,
                      const std::map<std::string, std::uint32_t>& landmarks) {
  constexpr int kRimSteps = 3;  // half the distance between the points of a pair, in steps
  constexpr double kMinDepthMm = 0.3;
  const auto upper = landmarks.find("lip_upper"), lower = landmarks.find("lip_lower");
  if (upper == landmarks.end() || lower == landmarks.end()) return {};
  const Eigen::Vector3d above = row3(wrap_template.positions, upper->second),
                        below = row3(wrap_template.positions, lower->second);
  const Eigen::Vector3d middle = (above + below) / 2;
  std::vector<Triangle> skin = wrap_template.skin.triangles;
  for (Triangle& t : skin) {
    for (std::uint32_t& v : t) v = wrap_template.skin.vertices[v];
  }
  const Profiles profiles(wrap_template.positions, skin, middle, wrap_template.axes);
  const double half = (above - below).dot(wrap_template.axes.up) / 2;
  const int count = static_cast<int>(2 * half / kStepMm) + 1 + 2 * kHalfWidthSteps;
  LipLine line;
  for (int column = -kColumnsPerSide; column <= kColumnsPerSide && half > 0; ++column) {
    const auto profile = profiles.trace(column * kColumnStepMm, -half - kHalfWidthMm, count);
    const std::vector<double> depths = Profiles::hollows(profile);
    const auto deepest = std::ranges::max_element(depths);
    if (*deepest < kMinDepthMm) continue;
    const auto i = static_cast<std::size_t>(deepest - depths.begin()) + kHalfWidthSteps;
    const auto &upper_rim = profile[i + kRimSteps], &lower_rim = profile[i - kRimSteps];
    if (std::min(upper_rim.depth, lower_rim.depth) == Profiles::kFarBehind) continue;
    line.push_back({upper_rim.point, lower_rim.point});
  }
  return line;
}

std::optional<ScanLipLine> find_scan_lip_line(const WrapTemplate& wrap_template,
                                              const LipLine& line, const Positions& wrapped,
                                              const Scan& scan, const Similarity& pose) {
  constexpr int kReachSteps = 40, kBlurSteps = 2;
  constexpr std::ptrdiff_t kOtherCreaseSteps = 10;
  constexpr double kMinDepthMm = 0.4, kMaxOtherShare = 0.7, kPlateauShare = 0.95, kMaxClosedMm = 1;
  if (line.size() < kColumnsPerSide) return std::nullopt;
  std::vector<Eigen::Vector3d> places;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& [upper, lower] : line) {
    places.push_back((point_on(wrapped, upper.corners, upper.barycentric) +
                      point_on(wrapped, lower.corners, lower.barycentric)) /
                     2);
    middle += places.back() / static_cast<double>(line.size());
  }
  const Profiles profiles(inverse(pose).apply(scan.positions), scan.triangles, middle,
                          wrap_template.axes);
  constexpr int kMargin = kReachSteps + kBlurSteps + kHalfWidthSteps;
  std::vector<double> sums(2 * kReachSteps + 1, 0);
  std::size_t wide_gaps = 0, gaps = 0;
  for (const Eigen::Vector3d& place : places) {
    const Eigen::Vector3d offset = place - middle;
    const auto profile =
        profiles.trace(offset.dot(wrap_template.axes.side()),
                       offset.dot(wrap_template.axes.up) - kMargin * kStepMm, 2 * kMargin + 1);
    const double gap = Profiles::gap_height(profile);
    if (gap > 2 * kHalfWidthMm) ++wide_gaps;
    if (gap > kMaxClosedMm) ++gaps;
    const std::vector<double> depths = Profiles::hollows(profile);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const auto begin = depths.begin() + static_cast<std::ptrdiff_t>(i);
      sums[i] += *std::max_element(begin, begin + 2 * kBlurSteps + 1);
    }
  }
  if (2 * wide_gaps > places.size()) return std::nullopt;  // the mouth is open
  const auto highest = std::ranges::max_element(sums);
  if (*highest < kMinDepthMm * static_cast<double>(places.size())) return std::nullopt;
  // A deep crease above the chin may be as clear as the line between thin lips. Otherwise, the line
  // is the middle of the highest sums.
  double sum = 0, count = 0;
  for (auto at = sums.begin(); at != sums.end(); ++at) {
    const bool is_beside = std::abs(at - highest) > kOtherCreaseSteps;
    if (is_beside && *at > kMaxOtherShare * *highest) return std::nullopt;
    if (is_beside || *at < kPlateauShare * *highest) continue;
    sum += static_cast<double>(at - sums.begin() - kReachSteps) * kStepMm;
    ++count;
  }
  return ScanLipLine{sum / count, 2 * gaps <= places.size()};
}

}  // namespace crowdface
