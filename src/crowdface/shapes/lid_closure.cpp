// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/lid_closure.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "crowdface/core/fixed_order.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"

namespace crowdface {
namespace {

// Lengths are fractions of the eyeball's radius, about 12 mm. Distances from the eyeball's centre:
// skin closer than kWholeShare follows the lid fully; skin farther than kNoShare does not move.
constexpr double kWholeShare = 1.8, kNoShare = 3;
// Distances from the eyeball's surface: skin closer than kWholeHold is kept off the eyeball fully,
// skin farther than kNoHold is not.
constexpr double kWholeHold = 0.27, kNoHold = 0.6;
constexpr std::size_t kPlaces = 52;  // number of places along the opening
constexpr double kProfile = 0.35;    // radius of the profile around each place
constexpr double kBlur = .12;        // width of the kernel that blends places along the opening
// Smallest decrease of the gap at a place at which the shape counts as closing the lids there.
constexpr double kMinClosed = 0.05;
/// Largest fraction of the gap at rest that may remain where the shape closes the template's lids.
constexpr double kMaxRemaining = 0.4;
// clearance between lid and eyeball that is kept where template and face at rest have it
constexpr double kMargin = 0.004;
/// Largest depth of skin in the eyeball, unless the skin is deeper at rest.
constexpr double kDeepest = 0.0125;
constexpr double kSomeDeeper = 0.002;  // depth beyond the limit that is tolerated
/// Where gaps must be corrected, lids are closed a little farther than on the template, by at most
/// this, so that the skin between the measured places closes too.
constexpr double kMaxExtraClosing = 0.02;
constexpr int kSteps = 8;
constexpr double kClosed = 0.016;  // a gap that counts as closed

/// Returns the position, in the shape, of one rim vertex of the upper or lower lid: the vertex
/// whose coordinate along the opening is nearest to `at`.
Eigen::Vector3d rim_at(const TemplateEye& eye, const Positions& shape, bool upper, double at,
                       const Eigen::Vector3d& along) {
  double nearest = std::numeric_limits<double>::max();
  Eigen::Vector3d found = eye.ball.centre();
  for (std::size_t r = 0; r < eye.lids.rim.size(); ++r) {
    if (eye.lids.upper[r] != upper) continue;
    const Eigen::Vector3d point = row3(shape, eye.lids.vertices[eye.lids.rim[r]]);
    const double distance = std::abs(point.dot(along) - at);
    if (distance >= nearest) continue;
    nearest = distance;
    found = point;
  }
  return found;
}

}  // namespace

void lid_sides(const TemplateEye& eye, const Positions& neutral, std::vector<signed char>& side) {
  for (const std::uint32_t v : eye.skin) {
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t r = 0; r < eye.lids.rim.size(); ++r) {
      const std::uint32_t rim = eye.lids.vertices[eye.lids.rim[r]];
      const double distance = (row3(neutral, v) - row3(neutral, rim)).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      side[v] = eye.lids.upper[r] ? 1 : -1;
    }
  }
}

BallMap::Gap FaceEye::gap_at(const Eigen::Vector3d& point) const {
  const BallMap::Gap found = ball->gap_at(motion.undo(point) - ball->centre());
  return {motion.scale * found.gap, motion.turn(found.normal) / motion.scale};
}

FaceEye face_eye(const TemplateEye& eye, const BallMap& ball, const RigidMotion& motion,
                 const Positions& mesh) {
  FaceEye there{&ball, motion};
  for (const std::uint32_t v : eye.skin) there.rest_gaps.push_back(there.gap_at(row3(mesh, v)).gap);
  return there;
}

LidClosure::LidClosure(const TemplateEye& eye, const Adjacency& adjacency, const Positions& neutral,
                       const Displacements& shape, const HeadAxes& axes)
    : axes_(axes), radius_(eye.ball.radius()) {
  if (eye.lids.rim.empty()) return;
  add_places(eye, adjacency, neutral, shape, axes);
  const FaceEye at_rest{&eye.ball, {}};
  const Eigen::Vector3d along = axes.side();
  for (std::uint32_t i = 0; i < eye.skin.size(); ++i) {
    const std::uint32_t v = eye.skin[i], row = index_in_list(shape.vertices, v);
    if (row == kNoIndex) continue;
    const Eigen::Vector3d before = row3(neutral, v), after = before + row3(shape.moves, row);
    const double gap_before = at_rest.gap_at(before).gap, gap_after = at_rest.gap_at(after).gap;
    const Eigen::Vector3d from = before - eye.ball.centre();
    LidVertex lid{row, v, i, 0, 0};
    lid.hold = smooth_step(kNoHold * radius_, kWholeHold * radius_,
                           std::min(std::abs(gap_before), std::abs(gap_after)));
    if (!places_.empty())
      lid.share = smooth_step(kNoShare * radius_, kWholeShare * radius_, from.norm());
    if (lid.share > 0 || lid.hold > 0) lids_.push_back(lid);
  }
  put_profiles_first();
  for (const LidVertex& lid : lids_) {
    const double at = (row3(neutral, lid.vertex) + row3(shape.moves, lid.row)).dot(along);
    const std::size_t first = gain_effects_.size();
    double sum = 0;
    for (const LidPlace& place : places_) {
      const double x = (at - place.along) / (kBlur * radius_);
      gain_effects_.push_back(1 / ((x * x + 1) * (x * x + 1)));
      sum += gain_effects_.back();
    }
    for (std::size_t p = first; p < gain_effects_.size(); ++p) gain_effects_[p] *= lid.share / sum;
  }
}

/// Moves the lid vertices that belong to profiles to the front of the list, because the search for
/// gains moves only these vertices.
void LidClosure::put_profiles_first() {
  std::set<std::uint32_t> rows;
  for (const LidPlace& place : places_) {
    for (const auto* points : {&place.low, &place.high}) {
      for (const Point& point : *points) rows.insert({point.row_a, point.row_b});
    }
  }
  const auto rest = std::stable_partition(
      lids_.begin(), lids_.end(), [&](const LidVertex& lid) { return rows.contains(lid.row); });
  in_profiles_ = static_cast<std::size_t>(rest - lids_.begin());
}

void LidClosure::add_places(const TemplateEye& eye, const Adjacency& adjacency,
                            const Positions& neutral, const Displacements& shape,
                            const HeadAxes& axes) {
  // Put places along the opening, between the corners of the eye.
  Positions closed = neutral;
  shape.add_to(closed);
  const Eigen::Vector3d along = axes.side();
  std::vector<signed char> sides(static_cast<std::size_t>(neutral.rows()), 0);
  lid_sides(eye, neutral, sides);
  const std::vector<double> side(sides.begin(), sides.end());
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const std::uint32_t r : eye.lids.rim) {
    const double at = row3(neutral, eye.lids.vertices[r]).dot(along);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const double at = low + (high - low) * (static_cast<double>(k) + 0.5) / kPlaces;
    const Eigen::Vector3d middle =
        (rim_at(eye, closed, true, at, along) + rim_at(eye, closed, false, at, along)) / 2;
    // Cut both lids across the opening, on the template in the shape. Keep the place if the shape
    // closes the lids enough.
    ContactPlace cut{middle + (at - middle.dot(along)) * along, axes.up, along, {}, {}};
    cut_profiles(adjacency, closed, eye.skin, side, kProfile * radius_, cut);
    if (cut.low.empty() || cut.high.empty()) continue;
    const double before = cut.gap(neutral), after = cut.gap(closed);
    if (before - after < kMinClosed * radius_ || after > kMaxRemaining * before) continue;
    LidPlace place{{}, {}, at, before - after};
    const auto add = [&](const std::vector<EdgePoint>& points, std::vector<Point>& to) {
      for (const EdgePoint& point : points) {
        to.push_back({point, index_in_list(shape.vertices, point.a),
                      index_in_list(shape.vertices, point.b)});
      }
    };
    add(cut.low, place.low);
    add(cut.high, place.high);
    places_.push_back(std::move(place));
  }
}

std::vector<std::uint32_t> LidClosure::rows() const {
  std::vector<std::uint32_t> rows;
  for (const LidVertex& lid : lids_) rows.push_back(lid.row);
  return rows;
}

LidClosure::EyeAxes LidClosure::axes_on(const RigidMotion& whole) const {
  return {whole.turn(axes_.side()) / whole.scale, whole.turn(axes_.up) / whole.scale};
}

LidClosure::Goals LidClosure::goals(const Positions& mesh, const FaceEye& eye,
                                    const RigidMotion& whole, const Positions& moves) const {
  Goals goals;
  if (!places_.empty()) goals.gaps = gaps(axes_on(whole), mesh, moves);
  for (Gap& gap : goals.gaps) gap = {gap.paired / whole.scale, gap.vertical / whole.scale};
  for (const LidVertex& lid : lids_) {
    const double after = eye.gap_at(row3(mesh, lid.vertex) + row3(moves, lid.row)).gap;
    goals.ball_distances.push_back(after / whole.scale);
    goals.distance_changes.push_back((after - eye.rest_gaps[lid.number]) / whole.scale);
  }
  return goals;
}

LidClosure::Goals LidClosure::mean(std::span<const Goals> goals, std::span<const SetShare> shares) {
  Goals mean;
  mean.gaps.assign(goals.front().gaps.size(), {0, 0});
  mean.ball_distances.assign(goals.front().ball_distances.size(), 0);
  mean.distance_changes = mean.ball_distances;
  for (const SetShare& of_set : shares) {
    const Goals& one = goals[of_set.set];
    for (std::size_t p = 0; p < mean.gaps.size(); ++p) {
      mean.gaps[p].paired += of_set.share * one.gaps[p].paired;
      mean.gaps[p].vertical += of_set.share * one.gaps[p].vertical;
    }
    for (std::size_t i = 0; i < mean.ball_distances.size(); ++i) {
      mean.ball_distances[i] += of_set.share * one.ball_distances[i];
      mean.distance_changes[i] += of_set.share * one.distance_changes[i];
    }
  }
  return mean;
}

LidClosure::RimPoint LidClosure::rim_point(const std::vector<Point>& points, double sign,
                                           const EyeAxes& axes, const Positions& face,
                                           const Positions& moves) {
  RimPoint rim{0, -std::numeric_limits<double>::max()};
  for (const Point& point : points) {
    Eigen::Vector3d at = (1 - point.edge.share) * row3(face, point.edge.a) +
                         point.edge.share * row3(face, point.edge.b);
    if (point.row_a != kNoIndex) at += (1 - point.edge.share) * row3(moves, point.row_a);
    if (point.row_b != kNoIndex) at += point.edge.share * row3(moves, point.row_b);
    const double height = sign * at.dot(axes.up);
    if (height > rim.height) rim = {at.dot(axes.along), height};
  }
  return {rim.along, sign * rim.height};
}

std::vector<LidClosure::Gap> LidClosure::gaps(const EyeAxes& axes, const Positions& face,
                                              const Positions& moves) const {
  std::vector<RimPoint> low;
  for (const LidPlace& place : places_) low.push_back(rim_point(place.low, 1, axes, face, moves));
  std::vector<RimPoint> sorted = low;
  std::sort(sorted.begin(), sorted.end(),
            [](const RimPoint& a, const RimPoint& b) { return a.along < b.along; });
  std::vector<Gap> gaps;
  for (std::size_t p = 0; p < places_.size(); ++p) {
    const RimPoint high = rim_point(places_[p].high, -1, axes, face, moves);
    const auto next =
        std::lower_bound(sorted.begin(), sorted.end(), high.along,
                         [](const RimPoint& rim, double at) { return rim.along < at; });
    double below = next == sorted.end() ? sorted.back().height : next->height;
    if (next != sorted.begin() && next != sorted.end()) {
      const RimPoint& before = *std::prev(next);
      const double t = (high.along - before.along) / (next->along - before.along);
      below = (1 - t) * before.height + t * next->height;
    }
    gaps.push_back({high.height - low[p].height, high.height - below});
  }
  return gaps;
}

void LidClosure::close(std::size_t count, const Eigen::Vector3d& up, const Positions& carried,
                       std::span<const double> gains, Positions& moves) const {
  for (std::size_t i = 0; i < count; ++i) {
    const LidVertex& lid = lids_[i];
    const Eigen::Vector3d move = row3(carried, lid.row);
    const double gain = fixed_dot(gain_effects(i), gains);
    moves.row(lid.row) = (move + gain * move.dot(up) * up).transpose();
  }
}

double LidClosure::min_gap(std::size_t lid, double rest, double scale, const Goals& goals) const {
  const double of_shape = std::max(scale * goals.ball_distances[lid], -kDeepest * scale * radius_);
  return std::min({rest, of_shape, kMargin * scale * radius_});
}

void LidClosure::keep_off_ball(std::size_t count, const Positions& face, const FaceEye& eye,
                               double scale, const Goals& goals, Positions& moves) const {
  for (std::size_t i = 0; i < count; ++i) {
    const LidVertex& lid = lids_[i];
    if (lid.hold == 0) continue;
    const BallMap::Gap now = eye.gap_at(row3(face, lid.vertex) + row3(moves, lid.row));
    const double rest = eye.rest_gaps[lid.number];
    const double wanted =
        std::max(rest + scale * goals.distance_changes[i], min_gap(i, rest, scale, goals));
    moves.row(lid.row) += (lid.hold * (wanted - now.gap) * now.normal).transpose();
  }
}

bool LidClosure::keep_out(const Positions& face, const FaceEye& eye, const RigidMotion& whole,
                          const Goals& goals, Positions& moves) const {
  const double tolerance = kSomeDeeper * whole.scale * radius_;
  bool is_out = true;
  for (std::size_t i = 0; i < lids_.size(); ++i) {
    const LidVertex& lid = lids_[i];
    if (lid.hold == 0) continue;
    const double least = min_gap(i, eye.rest_gaps[lid.number], whole.scale, goals);
    const BallMap::Gap now = eye.gap_at(row3(face, lid.vertex) + row3(moves, lid.row));
    if (now.gap >= least) continue;
    // The missing distance counts in proportion to `hold`, as the correction does.
    is_out = is_out && lid.hold * (least - now.gap) < tolerance;
    moves.row(lid.row) += (lid.hold * (least - now.gap) * now.normal).transpose();
  }
  return is_out;
}

double LidClosure::opening(const Positions& face, const RigidMotion& whole, const Goals& goals,
                           const Positions& moves) const {
  const std::vector<Gap> now = gaps(axes_on(whole), face, moves);
  double open = 0;
  for (std::size_t p = 0; p < now.size(); ++p) {
    const double allowed = std::max(goals.gaps[p].vertical / radius_, kClosed);
    open = std::max(open, now[p].vertical / (whole.scale * radius_) - allowed);
  }
  return open;
}

void LidClosure::close_again(const Positions& face, const RigidMotion& whole, const Goals& goals,
                             Positions& moves) const {
  const EyeAxes axes = axes_on(whole);
  std::vector<double> gains = missing_gaps(gaps(axes, face, moves), goals, whole.scale);
  for (std::size_t p = 0; p < places_.size(); ++p) {
    gains[p] = std::max(gains[p], 0.0) / (whole.scale * places_[p].closed);
  }
  const Positions carried = moves;
  close(lids_.size(), axes.up, carried, gains, moves);
}

std::vector<double> LidClosure::missing_gaps(const std::vector<Gap>& now, const Goals& goals,
                                             double scale) {
  std::vector<double> missing;
  for (std::size_t p = 0; p < now.size(); ++p) {
    const Gap& wanted = goals.gaps[p];
    missing.push_back(std::max(now[p].paired - scale * wanted.paired,
                               now[p].vertical - scale * std::max(wanted.vertical, 0.0)));
  }
  return missing;
}

void LidClosure::fit(const Positions& face, const FaceEye& eye, const RigidMotion& whole,
                     const Goals& goals, Positions& moves) const {
  const EyeAxes axes = axes_on(whole);
  if (places_.empty()) {
    return keep_off_ball(lids_.size(), face, eye, whole.scale, goals, moves);
  }
  const Positions carried = moves;
  std::vector<double> gains(places_.size(), 0.0);
  double sure = 0;
  // Chord method (Newton with a fixed slope) for the gains. A gain of one narrows the gap at a
  // place by as much as the shape does on the template.
  for (int step = 0; step < kSteps; ++step) {
    if (step > 0) close(in_profiles_, axes.up, carried, gains, moves);
    keep_off_ball(in_profiles_, face, eye, whole.scale, goals, moves);
    const std::vector<double> missing = missing_gaps(gaps(axes, face, moves), goals, whole.scale);
    if (step == 0) {
      for (const double gap : missing) sure = std::max(sure, std::abs(gap) / 2);
      sure = std::min(sure, kMaxExtraClosing * whole.scale * radius_);
    }
    for (std::size_t p = 0; p < places_.size(); ++p) {
      gains[p] += (missing[p] + sure) / (whole.scale * places_[p].closed);
    }
  }
  close(lids_.size(), axes.up, carried, gains, moves);
  keep_off_ball(lids_.size(), face, eye, whole.scale, goals, moves);
}

}  // namespace crowdface
