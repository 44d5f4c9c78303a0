// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/face_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/polygon_sample.h"
#include "crowdface/paint/depth_map.h"

namespace crowdface {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// A candidate for the face's position and size on the searched surface.
struct Candidate {
  /// Coordinates of the point between the eyes, along the side axis and up; and see
  /// ReliefMatch::scale and ReliefMatch::stretch.
  double across = 0, height = 0, scale = 1, stretch = 1;
  ReliefFit fit;      ///< comparison of the surface at this position with the mean face
  double score = -1;  ///< see ReliefMatch::score
};

double diagonal_of(const Positions& samples) {
  return (samples.colwise().maxCoeff() - samples.colwise().minCoeff()).norm();
}

HeadAxes turned(const HeadAxes& axes, const Eigen::Vector3d& about, double degrees) {
  const Eigen::AngleAxisd turn(degrees * kRadians, about);
  return {turn * axes.front, turn * axes.up};
}

/// Angle in degrees of the rotation that turns the axes `a` into the axes `b`.
double angle_between(const HeadAxes& a, const HeadAxes& b) {
  const double trace = a.front.dot(b.front) + a.up.dot(b.up) + a.side().dot(b.side());
  return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) / kRadians;
}

/// The score of a match is its correlation plus kEyeAgreementWeight times the result of
/// eye_agreement.
constexpr double kEyeAgreementWeight = 0.15;

/// Compares the midpoint between the known eyeballs with the midpoint between the eyes of the
/// relief, as a match places the relief on the surface. Returns 1 if these two points are closer
/// together than kNearMm, −1 if they are farther apart, and 0 if no eyeballs are known.
/// \param across, height  coordinates of the relief's midpoint, along the side axis and up
int eye_agreement(const std::vector<Eigen::Vector3d>& eyes, const HeadAxes& axes, double across,
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

/// Finds the position and size at which the relief matches best, seen along `axes`.
/// \param coarseness  width of the search steps as a multiple of the finest steps
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
  // Search for the relief with scales in a geometric sequence, in parallel. `of_scale` holds the
  // best candidate of each scale.
  std::vector<Candidate> of_scale;
  for (double scale = kMinShare * breadth / kReliefMm; scale < kMaxShare * breadth / kReliefMm;
       scale *= grow) {
    of_scale.emplace_back().scale = scale;
  }
  parallel_for_each(of_scale.size(), [&](std::size_t k) {
    Candidate& best = of_scale[k];
    const double scale = best.scale;
    const double top = box.max().y() - 0.5 * kReliefTopRowHeightMm * scale,
                 low = box.min().y() + kReliefTopRowHeightMm * scale;
    // Try the relief at all heights on the surface, and at lateral positions whose distance from
    // the surface's middle is at most a quarter of the surface's breadth.
    const int aside = static_cast<int>(std::floor(0.25 * breadth / (aside_mm * scale)));
    for (double height = low; height < top; height += up_mm * scale) {
      for (int i = -aside; i <= aside; ++i) {
        const double across = box.center().x() + i * aside_mm * scale;
        const ReliefFit fit = map.fit(across, height, scale);
        if (!(fit.amplitude >= kMinAmplitude && fit.amplitude <= kMaxAmplitude)) continue;
        const double score = fit.correlation +
                             kEyeAgreementWeight * eye_agreement(eyes, axes, across, height, scale);
        if (score > best.score) best = {across, height, scale, 1, fit, score};
      }
    }
  });
  if (of_scale.empty()) return {};
  return *std::ranges::max_element(of_scale, {}, &Candidate::score);
}

ReliefMatch match_of(const Candidate& candidate, const HeadAxes& axes) {
  const double depth =
      candidate.fit.offset + candidate.fit.amplitude * depth_of_mean_face_mm(kCellBetweenEyes);
  return {candidate.fit.correlation,
          candidate.score,
          0,
          0,
          axes,
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
    constexpr double kAroundMm = 160, kBehindMm = 80;
    constexpr std::size_t kMax = 60'000;
    std::vector<Index> near;
    for (Index i = 0; i < samples.rows(); ++i) {
      const Eigen::Vector3d off = (row3(samples, i) - first.eye_midpoint) / first.scale;
      if (off.norm() < kAroundMm && off.dot(first.fitted_axes.front) > -kBehindMm)
        near.push_back(i);
    }
    if (const std::size_t step = near.size() / kMax; step > 1) {
      for (std::size_t i = 0; i * step < near.size(); ++i) near[i] = near[i * step];
      near.resize(near.size() / step);
    }
    nearby_samples_ = samples(near, kAllColumns);
    cell_size_ = kCellMm * first.scale;
    try_match(first);
  }

  ReliefMatch find() {
    search();
    make_symmetric();
    ReliefMatch best = best_;
    double highest = kWorst;
    for (const ReliefMatch& start : starts_in_symmetry_plane()) {
      restart(start, start.fitted_axes);
      for (int round = 0; round < kRounds && make_upright() >= kSteadyDegrees; ++round) {
      }
      if (score_ <= highest) continue;
      highest = score_;
      best = best_;
    }
    restart(best, best.fitted_axes);
    for (int round = 0; round < kRounds; ++round) {
      const HeadAxes before = best_.fitted_axes;
      make_symmetric();
      make_upright();
      if (angle_between(before, best_.fitted_axes) < kSteadyDegrees) break;
    }
    refine_placement();
    return best_;
  }

 private:
  static constexpr double kCellMm = 2, kTurnDegrees = 8, kMoveMm = 6, kGrow = 0.08;
  static constexpr double kMaxStretch = 0.25;  // limit of the logarithm of the stretch
  static constexpr double kStretchPenalty = 1, kAmplitudePenalty = 0.2;
  static constexpr double kWorst = -2;
  static constexpr int kRounds = 6;
  static constexpr double kSteadyDegrees = 0.3;

  /// Finds matches from which to start the pattern search. The score has several maxima, and the
  /// start match determines which maximum a pattern search reaches. Tries a grid of pitches,
  /// heights, sizes and stretches.
  /// \return the matches with the highest scores that differ from each other in size or height
  std::vector<ReliefMatch> starts_in_symmetry_plane() {
    constexpr std::size_t kStarts = 4;
    constexpr double kOtherSize = 0.12, kOtherHeightMm = 10;
    struct Start {
      double score = kWorst;
      ReliefMatch match;
    };
    const ReliefMatch middle = best_;
    std::vector<Start> found = {{score_, best_}};
    for (const double pitch : {-20, -10, 0, 10, 20}) {
      const HeadAxes axes = turned(middle.fitted_axes, middle.fitted_axes.side(), pitch);
      for (int grow = -4; grow <= 4; ++grow) {
        ReliefMatch next = middle;
        next.scale = middle.scale * std::pow(1 + kGrow, grow);
        restart(next, axes);
        for (int up = -5; up <= 5; ++up) {
          for (int stretch = -2; stretch <= 2; ++stretch) {
            next = middle;
            next.fitted_axes = axes;
            next.eye_midpoint += up * kMoveMm * middle.scale * axes.up;
            next.scale = middle.scale * std::pow(1 + kGrow, grow);
            next.stretch = 1 + stretch * kGrow;
            try_match(next);
          }
        }
        found.push_back({score_, best_});
      }
    }
    std::ranges::stable_sort(found, std::greater(), &Start::score);
    std::vector<ReliefMatch> starts;
    for (const Start& start : found) {
      const bool is_new = std::ranges::none_of(starts, [&](const ReliefMatch& other) {
        const double up =
            (start.match.eye_midpoint - other.eye_midpoint).dot(middle.fitted_axes.up) /
            middle.scale;
        return std::abs(std::log(start.match.scale / other.scale)) < kOtherSize &&
               std::abs(up) < kOtherHeightMm;
      });
      if (is_new && starts.size() < kStarts) starts.push_back(start.match);
    }
    return starts;
  }

  /// Rotates the axes of the best match so far (`best_`), so that the face is as upright as the
  /// mean face. The angle comes from the fit of the relief: how much the face's depth grows with
  /// height, compared with the mean face (`slope_up_`).
  /// \return the absolute angle of the rotation in degrees
  double make_upright() {
    refine_placement();
    const double pitch = std::atan(slope_up_) / kRadians;
    restart(best_, turned(best_.fitted_axes, best_.fitted_axes.side(), pitch));
    return std::abs(pitch);
  }

  void search(bool turns = true) {
    for (double step = 1; step >= 1.0 / 16;) {
      const double before = score_;
      step_all(step, turns);
      if (!(score_ > before + 2e-5)) step /= 2;
    }
  }

  /// Replaces the best match (`best_`) by `match` with its axes changed to `axes`, even if the
  /// score decreases.
  void restart(const ReliefMatch& match, const HeadAxes& axes) {
    ReliefMatch next = match;
    next.fitted_axes = axes;
    score_ = kWorst;
    try_match(next);
    if (score_ <= kWorst) best_ = next;
  }

  /// Returns the differences between the depths at points of the left half of the face and at their
  /// mirror images on the right half. The mirror plane contains `middle` and is perpendicular to
  /// `axes.side()`.
  std::vector<double> asymmetry(const HeadAxes& axes, const Eigen::Vector3d& middle) const {
    constexpr double kHighMm = 40, kLowMm = -100, kAsideMm = 60, kStepMm = 4;
    DepthMap map(nearby_samples_, axes, cell_size_);
    map.smooth();
    const double mm = best_.scale, across = middle.dot(axes.side()), height = middle.dot(axes.up);
    std::vector<double> differences;
    for (double y = kLowMm; y <= kHighMm; y += kStepMm) {
      for (double x = kStepMm; x <= kAsideMm; x += kStepMm) {
        const double left = map.depth(across + x * mm, height + y * best_.stretch * mm);
        const double right = map.depth(across - x * mm, height + y * best_.stretch * mm);
        differences.push_back((left - right) / mm);  // not finite where a surface is missing
      }
    }
    return differences;
  }

  /// Finds the symmetry plane of the face: turns the axes of the match about the up axis and the
  /// front axis, and moves its origin sideways, until the face is symmetric in these axes. Uses
  /// robust Gauss-Newton steps.
  void make_symmetric() {
    constexpr int kSteps = 8;
    constexpr double kDegrees = 2, kMm = 2;  // step sizes for numerical derivatives
    constexpr double kMaxSteps = 4, kSteadySteps = 0.05, kMinMm = 1;
    HeadAxes axes = best_.fitted_axes;
    Eigen::Vector3d middle = best_.eye_midpoint;
    for (int step = 0; step < kSteps; ++step) {
      const auto moved = [&](const Eigen::Vector3d& by) {
        HeadAxes next = turned(axes, axes.up, kDegrees * by(0));
        next = turned(next, axes.front, kDegrees * by(1));
        return asymmetry(next, middle + kMm * best_.scale * by(2) * axes.side());
      };
      const std::vector<double> now = moved(Eigen::Vector3d::Zero());
      std::array<std::vector<double>, 3> ahead, back;
      for (int k = 0; k < 3; ++k) {
        ahead[k] = moved(Eigen::Vector3d::Unit(k));
        back[k] = moved(-Eigen::Vector3d::Unit(k));
      }
      std::vector<double> sizes;
      for (const double d : now) {
        if (std::isfinite(d)) sizes.push_back(std::abs(d));
      }
      if (sizes.size() < 50) return;
      const double usual = std::max(kMinMm, 2.5 * nth_smallest(sizes, sizes.size() / 2));
      Eigen::Matrix3d products = Eigen::Matrix3d::Identity();
      Eigen::Vector3d sums = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < now.size(); ++i) {
        Eigen::Vector3d by;
        for (int k = 0; k < 3; ++k) by(k) = (ahead[k][i] - back[k][i]) / 2;
        if (!std::isfinite(now[i]) || !by.allFinite()) continue;
        const double off = now[i] / usual, weight = 1 / ((1 + off * off) * (1 + off * off));
        products += weight * by * by.transpose();
        sums -= weight * now[i] * by;
      }
      Eigen::Vector3d by = products.ldlt().solve(sums);
      const double size = by.cwiseAbs().maxCoeff();
      if (size > kMaxSteps) by *= kMaxSteps / size;
      const HeadAxes old = axes;
      axes = turned(axes, old.up, kDegrees * by(0));
      axes = turned(axes, old.front, kDegrees * by(1));
      middle += kMm * best_.scale * by(2) * old.side();
      if (size < kSteadySteps) break;
    }
    ReliefMatch next = best_;
    next.eye_midpoint = middle;
    restart(next, axes);
  }

  /// Searches for better heights, sizes and stretches near those of the best match: first on a
  /// grid, then by pattern search.
  void refine_placement() {
    const ReliefMatch first = best_;
    for (int up = -3; up <= 3; ++up) {
      for (int grow = -3; grow <= 3; ++grow) {
        for (int stretch = -2; stretch <= 2; ++stretch) {
          ReliefMatch next = first;
          next.eye_midpoint += up * kMoveMm * first.scale * first.fitted_axes.up;
          next.scale *= 1 + grow * 0.5 * kGrow;
          next.stretch = 1 + stretch * kGrow;
          try_match(next);
        }
      }
    }
    search(false);
  }

  /// Changes each parameter of the best match by one step up and one step down, and keeps the
  /// changes that improve the match.
  /// \param turns  whether to change the rotation and the lateral position too
  void step_all(double step, bool turns) {
    for (const double sign : {1.0, -1.0}) {
      if (!turns) break;
      const HeadAxes axes = best_.fitted_axes;
      ReliefMatch next = best_;
      next.fitted_axes = turned(axes, axes.up, sign * step * kTurnDegrees);
      try_match(next);
      next = best_;
      next.fitted_axes = turned(axes, axes.front, sign * step * kTurnDegrees);
      try_match(next);
    }
    for (const double sign : {1.0, -1.0}) {
      const double move = sign * step * kMoveMm * best_.scale;
      ReliefMatch next = best_;
      if (turns) {
        next.eye_midpoint += move * best_.fitted_axes.side();
        try_match(next);
        next = best_;
      }
      next.eye_midpoint += move * best_.fitted_axes.up;
      try_match(next);
      next = best_;
      next.scale *= 1 + sign * step * kGrow;
      try_match(next);
      next = best_;
      next.stretch *= 1 + sign * step * kGrow;
      try_match(next);
    }
  }

  /// Makes a match the new best match if the match has a higher score than the old best match and a
  /// plausible stretch.
  void try_match(const ReliefMatch& match) {
    if (!map_ || match.fitted_axes.front != map_axes_.front ||
        match.fitted_axes.up != map_axes_.up) {
      map_.emplace(nearby_samples_, match.fitted_axes, cell_size_).smooth();
      map_axes_ = match.fitted_axes;
    }
    Candidate candidate{match.eye_midpoint.dot(match.fitted_axes.side()),
                        match.eye_midpoint.dot(match.fitted_axes.up),
                        match.scale,
                        match.stretch,
                        {},
                        0};
    candidate.fit =
        map_->fit(candidate.across, candidate.height, candidate.scale, candidate.stretch);
    const double stretch = std::log(match.stretch);
    const double height = std::log(std::max(candidate.fit.amplitude, 0.1));
    const double score = candidate.fit.correlation - kStretchPenalty * stretch * stretch -
                         kAmplitudePenalty * height * height;
    if (std::abs(stretch) < kMaxStretch && score > score_) {
      score_ = score;
      best_ = match_of(candidate, match.fitted_axes);
      slope_up_ = candidate.fit.slope_up / match.stretch;
    }
  }

  Positions nearby_samples_;
  std::optional<DepthMap> map_;  ///< depth map of the samples, seen along map_axes_
  HeadAxes map_axes_;
  double cell_size_ = 1, slope_up_ = 0, score_ = kWorst;
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
      const Eigen::Vector3d b = row3(positions, face[at.second_corner]);
      const Eigen::Vector3d c = row3(positions, face[at.second_corner + 1]);
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
  // The search along rotated axes uses steps that are wider by this factor, because there are many
  // rotated axes.
  constexpr double kCoarser = 1.5;
  constexpr double kTurn = 25;         // angle of the rotated axes, in degrees
  constexpr double kSureScore = 0.75;  // nearly all matches with a higher score are faces
  // A face counts as aligned with the requested axes if the axes of the face differ from the
  // requested axes by less than this angle, in degrees.
  constexpr double kAlignedDegrees = 5;
  // If the face is pitched up or down by less than this angle, in degrees, relative to the nearest
  // requested axes, the pitch is ignored: it is due to the posture of the head or the shape of the
  // face.
  constexpr double kMinPitch = 10;
  if (samples.rows() == 0 || !(diagonal_of(samples) > 0)) return std::nullopt;
  const auto search = [&](const std::vector<HeadAxes>& views, double coarseness) {
    std::vector<Candidate> found(views.size());
    parallel_for_each(views.size(), [&](std::size_t i) {
      found[i] = search_view(samples, views[i], eyes, coarseness);
    });
    // Refine several candidates before the final comparison: without refinement, a candidate with a
    // wrong rotation may have as high a score as the right candidate.
    std::vector<std::size_t> order(views.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return found[i].score; });
    order.resize(std::min(order.size(), kRefined));
    std::vector<ReliefMatch> refined(order.size());
    parallel_for_each(order.size(), [&](std::size_t i) {
      const Candidate& one = found[order[i]];
      if (one.score <= -1) return;
      ReliefMatch& match = refined[i];
      match = Refinement(samples, match_of(one, views[order[i]])).find();
      match.score = match.correlation +
                    kEyeAgreementWeight *
                        eye_agreement(eyes, match.axes, match.eye_midpoint.dot(match.axes.side()),
                                      match.eye_midpoint.dot(match.axes.up), match.scale);
    });
    ReliefMatch match = *std::ranges::max_element(refined, {}, &ReliefMatch::score);
    if (match.score <= -1) return match;
    // Among the caller's orientations (`all_axes`), choose the one that differs from the axes of
    // the face by the smallest angle.
    match.nearest_orientation_index = static_cast<std::size_t>(
        std::ranges::min_element(
            all_axes, {}, [&](const HeadAxes& asked) { return angle_between(match.axes, asked); }) -
        all_axes.begin());
    const HeadAxes& asked = all_axes[match.nearest_orientation_index];
    match.rotation_degrees = angle_between(match.axes, asked);
    // Remove a small pitch from the axes of the match: a small pitch is due to the posture of the
    // head or the form of the face.
    const double pitch =
        std::asin(std::clamp(match.fitted_axes.up.dot(asked.front), -1.0, 1.0)) / kRadians;
    if (std::abs(pitch) < kMinPitch) {
      match.axes = turned(match.fitted_axes, match.fitted_axes.side(), -pitch);
    }
    if (angle_between(match.axes, asked) < kAlignedDegrees) match.axes = asked;
    return match;
  };
  const auto rotated_views = [&](const std::vector<double>& pitches) {
    std::vector<HeadAxes> views;
    for (const HeadAxes& axes : all_axes) {
      for (const double pitch : pitches) {
        for (const double yaw : {0.0, kTurn, -kTurn}) {
          for (const double roll : {0.0, kTurn, -kTurn}) {
            if (pitch == 0 && yaw == 0 && roll == 0) continue;
            const HeadAxes pitched = turned(axes, axes.side(), pitch);
            views.push_back(turned(turned(pitched, axes.front, roll), axes.up, yaw));
          }
        }
      }
    }
    return views;
  };
  // Most calls request only one pair of axes, and must be fast. The search along a single pair of
  // axes therefore uses wider steps, which almost always find the face. If the wider steps miss the
  // face, the search along rotated axes follows.
  const double coarseness = all_axes.size() == 1 ? 1.3 : 1;
  ReliefMatch match = search(all_axes, coarseness);
  if (match.score < kMinScore || match.rotation_degrees > kTurn) {
    // Few faces need the views with a pitch, because the refinement also changes the pitch.
    for (const std::vector<double>& pitches : {std::vector{0.0}, std::vector{-kTurn, kTurn}}) {
      const ReliefMatch other = search(rotated_views(pitches), kCoarser);
      if (other.score > match.score) match = other;
      if (match.score >= kSureScore || all_axes.size() == 1) break;
    }
  }
  return match;
}

}  // namespace crowdface
