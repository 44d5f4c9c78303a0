// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/face_relief.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/polygon_sample.h"
#include "crowdface/paint/depth_map.h"

namespace crowdface {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// A position of the relief and its agreement there.
struct Candidate {
  double across = 0, height = 0, scale = 1, stretch = 1;
  ReliefFit fit;
  double votes = -1;
};

double diagonal_of(const Positions& samples) {
  return (samples.colwise().maxCoeff() - samples.colwise().minCoeff()).norm();
}

HeadAxes turned(const HeadAxes& axes, const Eigen::Vector3d& about, double degrees) {
  const Eigen::AngleAxisd turn(degrees * kRadians, about);
  return {turn * axes.front, turn * axes.up};
}

/// Angle in degrees of the rotation from one frame to the other.
double angle_between(const HeadAxes& a, const HeadAxes& b) {
  const double trace = a.front.dot(b.front) + a.up.dot(b.up) + a.side().dot(b.side());
  return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) / kRadians;
}

constexpr double kVoteOfEyes = 0.15;

/// Compares the known eyeballs with the eyes of a match: 1 if they agree, −1 if not, 0 without
/// eyeballs.
int vote_of_eyes(const std::vector<Eigen::Vector3d>& eyes, const HeadAxes& axes, double across,
                 double height, double scale) {
  constexpr double kNearMm = 20;
  if (eyes.empty()) return 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& eye : eyes) middle += eye / static_cast<double>(eyes.size());
  return std::hypot(middle.dot(axes.side()) - across, middle.dot(axes.up) - height) <
                 kNearMm * scale
             ? 1
             : -1;
}

/// Finds the best position of the relief in one view, over all sizes.
/// \param coarseness  step width as a multiple of the finest steps
Candidate search_view(const Positions& samples, const HeadAxes& axes,
                      const std::vector<Eigen::Vector3d>& eyes, double coarseness) {
  constexpr double kMinAmplitude = 0.45, kMaxAmplitude = 2;
  constexpr double kSquares = 150;  // number of squares along the diagonal
  constexpr double kMinShare = 0.15,
                   kMaxShare = 0.85;  // width of the relief as fractions of the surface's breadth
  constexpr double kReliefMm = kReliefSpacingMm * (kReliefColumns - 1);
  const double grow = std::pow(1.15, coarseness), up_mm = 6 * coarseness,
               aside_mm = 10 * coarseness;
  const DepthMap map(samples, axes, diagonal_of(samples) / kSquares);
  const Eigen::AlignedBox2d& box = map.box();
  const double breadth = box.sizes().x();
  // Sizes to try, in a geometric sequence; each size is searched in parallel.
  std::vector<Candidate> of_scale;
  for (double scale = kMinShare * breadth / kReliefMm; scale < kMaxShare * breadth / kReliefMm;
       scale *= grow) {
    of_scale.emplace_back().scale = scale;
  }
  parallel_for_each(of_scale.size(), [&](std::size_t k) {
    Candidate& best = of_scale[k];
    const double scale = best.scale;
    const double top = box.max().y() - 0.5 * kReliefTopMm * scale,
                 low = box.min().y() + kReliefTopMm * scale;
    // All heights, and positions across up to a quarter of the breadth from the middle.
    const int aside = static_cast<int>(std::floor(0.25 * breadth / (aside_mm * scale)));
    for (double height = low; height < top; height += up_mm * scale) {
      for (int i = -aside; i <= aside; ++i) {
        const double across = box.center().x() + i * aside_mm * scale;
        const ReliefFit fit = map.fit(across, height, scale);
        if (!(fit.amplitude >= kMinAmplitude && fit.amplitude <= kMaxAmplitude)) continue;
        const double votes =
            fit.agreement + kVoteOfEyes * vote_of_eyes(eyes, axes, across, height, scale);
        if (votes > best.votes) best = {across, height, scale, 1, fit, votes};
      }
    }
  });
  if (of_scale.empty()) return {};
  return *std::ranges::max_element(of_scale, {}, &Candidate::votes);
}

ReliefMatch match_of(const Candidate& candidate, const HeadAxes& axes) {
  const double depth = candidate.fit.offset + candidate.fit.amplitude * relief_mm(kBetweenEyes);
  return {candidate.fit.agreement,
          candidate.votes,
          0,
          0,
          axes,
          candidate.across * axes.side() + candidate.height * axes.up +
              depth * candidate.scale * axes.front,
          candidate.scale,
          candidate.stretch};
}

/// Refines rotation, position and size of a match by pattern search (Hooke & Jeeves 1961).
class Refinement {
 public:
  Refinement(const Positions& samples, const ReliefMatch& first) : best_(first) {
    constexpr double kAroundMm = 110, kBehindMm = 80;
    constexpr std::size_t kMax = 20'000;
    std::vector<Index> near;
    for (Index i = 0; i < samples.rows(); ++i) {
      const Eigen::Vector3d off = (row3(samples, i) - first.between) / first.scale;
      if (off.norm() < kAroundMm && off.dot(first.axes.front) > -kBehindMm) near.push_back(i);
    }
    if (const std::size_t step = near.size() / kMax; step > 1) {
      for (std::size_t i = 0; i * step < near.size(); ++i) near[i] = near[i * step];
      near.resize(near.size() / step);
    }
    near_ = samples(near, kAllColumns);
    square_ = kSquareMm * first.scale;
    try_match(first);
  }

  ReliefMatch find() {
    search();
    // A slope of the depths shows that the head is pitched: compensate the pitch and search again.
    // Smaller angles come from the person's posture or from the form of the face.
    const double pitch = std::atan(slope_up_) / kRadians;
    if (std::abs(pitch) > kMinPitch) {
      ReliefMatch next = best_;
      next.axes = turned(best_.axes, best_.axes.side(), pitch);
      best_.agreement = -1;
      try_match(next);
      search();
    }
    return best_;
  }

 private:
  static constexpr double kSquareMm = 2, kTurnDegrees = 8, kMoveMm = 6, kGrow = 0.08;
  static constexpr double kMaxStretch = 0.25;  // of the logarithm of the stretch
  static constexpr double kMinPitch = 10;      // degrees

  void search() {
    for (double step = 1; step >= 1.0 / 16;) {
      const double before = best_.agreement;
      step_all(step);
      if (!(best_.agreement > before + 2e-5)) step /= 2;
    }
  }

  /// Tries a step of each parameter in both directions.
  void step_all(double step) {
    for (const double sign : {1.0, -1.0}) {
      const HeadAxes axes = best_.axes;
      ReliefMatch next = best_;
      next.axes = turned(axes, axes.up, sign * step * kTurnDegrees);
      try_match(next);
      next = best_;
      next.axes = turned(axes, axes.front, sign * step * kTurnDegrees);
      try_match(next);
    }
    for (const double sign : {1.0, -1.0}) {
      const double move = sign * step * kMoveMm * best_.scale;
      ReliefMatch next = best_;
      next.between += move * best_.axes.side();
      try_match(next);
      next = best_;
      next.between += move * best_.axes.up;
      try_match(next);
      next = best_;
      next.scale *= 1 + sign * step * kGrow;
      try_match(next);
      next = best_;
      next.stretch *= 1 + sign * step * kGrow;
      try_match(next);
    }
  }

  /// Keeps a match if it agrees better than the best match and its stretch is plausible.
  void try_match(const ReliefMatch& match) {
    if (!map_ || match.axes.front != map_axes_.front || match.axes.up != map_axes_.up) {
      map_.emplace(near_, match.axes, square_).soften();
      map_axes_ = match.axes;
    }
    Candidate candidate{match.between.dot(match.axes.side()),
                        match.between.dot(match.axes.up),
                        match.scale,
                        match.stretch,
                        {},
                        0};
    candidate.fit =
        map_->fit(candidate.across, candidate.height, candidate.scale, candidate.stretch);
    const bool is_likely = std::abs(std::log(match.stretch)) < kMaxStretch;
    if (is_likely && candidate.fit.agreement > best_.agreement) {
      best_ = match_of(candidate, match.axes);
      slope_up_ = candidate.fit.slope_up / match.stretch;
    }
  }

  Positions near_;
  std::optional<DepthMap> map_;  ///< depth map seen along map_axes_
  HeadAxes map_axes_;
  double square_ = 1, slope_up_ = 0;
  ReliefMatch best_;
};

}  // namespace

Positions sample_skin(const Topology& topology, const Positions& positions,
                      const std::vector<bool>& skin, Index count) {
  double area = 0;
  const auto area_of = [&](Index f) {
    return skin[topology.face(f)[0]] ? face_area_vector(topology, f, positions).norm() : 0;
  };
  for (Index f = 0; f < topology.face_count(); ++f) area += area_of(f);
  if (!(area > 0) || !std::isfinite(area)) return {};
  Positions samples(count, 3);
  Index made = 0;
  double passed = 0;
  for (Index f = 0; f < topology.face_count(); ++f) {
    passed += area_of(f);
    const auto face = topology.face(f);
    const auto until = static_cast<Index>(passed / area * static_cast<double>(count));
    for (Index i = made; i < std::min(until, count); ++i) {
      const PolygonSample at = polygon_sample(static_cast<std::size_t>(i), face.size());
      const Eigen::Vector3d a = row3(positions, face[0]);
      const Eigen::Vector3d b = row3(positions, face[at.fan]);
      const Eigen::Vector3d c = row3(positions, face[at.fan + 1]);
      samples.row(i) = (a + at.s * (b - a) + at.t * (c - a)).transpose();
    }
    made = std::max(made, std::min(until, count));
  }
  samples.conservativeResize(made, 3);
  return samples;
}

std::optional<ReliefMatch> match_relief(const Positions& samples,
                                        const std::vector<HeadAxes>& all_axes,
                                        const std::vector<Eigen::Vector3d>& eyes) {
  constexpr std::size_t kRefined = 6;
  constexpr double kCoarser = 1.5;  // step width in the rotated views, because there are many
  constexpr double kTurn = 25;      // rotation of the rotated views, in degrees
  // A face within this angle in degrees counts as aligned with the axes.
  constexpr double kStraight = 5;
  if (samples.rows() == 0 || !(diagonal_of(samples) > 0)) return std::nullopt;
  const auto search = [&](const std::vector<HeadAxes>& views, double coarseness) {
    std::vector<Candidate> found(views.size());
    parallel_for_each(views.size(), [&](std::size_t i) {
      found[i] = search_view(samples, views[i], eyes, coarseness);
    });
    // Compares the best views after refinement, because only refinement shows that a view with the
    // wrong rotation agrees less.
    std::vector<std::size_t> order(views.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return found[i].votes; });
    order.resize(std::min(order.size(), kRefined));
    std::vector<ReliefMatch> refined(order.size());
    parallel_for_each(order.size(), [&](std::size_t i) {
      const Candidate& one = found[order[i]];
      if (one.votes <= -1) return;
      ReliefMatch& match = refined[i];
      match = Refinement(samples, match_of(one, views[order[i]])).find();
      match.votes =
          match.agreement +
          kVoteOfEyes * vote_of_eyes(eyes, match.axes, match.between.dot(match.axes.side()),
                                     match.between.dot(match.axes.up), match.scale);
    });
    ReliefMatch match = *std::ranges::max_element(refined, {}, &ReliefMatch::votes);
    if (match.votes <= -1) return match;
    // The requested axes nearest to the axes of the face.
    match.view = static_cast<std::size_t>(
        std::ranges::min_element(
            all_axes, {}, [&](const HeadAxes& asked) { return angle_between(match.axes, asked); }) -
        all_axes.begin());
    match.degrees_off = angle_between(match.axes, all_axes[match.view]);
    if (match.degrees_off < kStraight) match.axes = all_axes[match.view];
    return match;
  };
  std::vector<HeadAxes> others;
  for (const HeadAxes& axes : all_axes) {
    for (const double yaw : {0.0, kTurn, -kTurn}) {
      for (const double roll : {0.0, kTurn, -kTurn}) {
        if (yaw == 0 && roll == 0) continue;
        others.push_back(turned(turned(axes, axes.front, roll), axes.up, yaw));
      }
    }
  }
  // Most runs have one pair of axes, so this case must be fast. Wide steps almost always find the
  // face; otherwise the rotated views follow.
  const double coarseness = all_axes.size() == 1 ? 1.3 : 1;
  ReliefMatch match = search(all_axes, coarseness);
  if (match.votes < kMinVotes || match.degrees_off > kTurn) {
    const ReliefMatch other = search(others, kCoarser);
    if (other.votes > match.votes) match = other;
  }
  return match;
}

}  // namespace crowdface
