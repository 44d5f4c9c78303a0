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
// skin closer than kFullMotionRadius moves fully with the lid; skin farther than kNoMotionRadius
// does not move.
constexpr double kFullMotionRadius = 1.8, kNoMotionRadius = 3;
// Distances from the eyeball's surface, as fractions of the eyeball's radius. Skin closer than
// kFullCorrectionGap is kept outside the eyeball. Farther away, this correction fades, and ends at
// kNoCorrectionGap.
constexpr double kFullCorrectionGap = 0.27, kNoCorrectionGap = 0.6;
constexpr std::size_t kSections = 52;  // number of sections along the opening
constexpr double kProfile = 0.35;      // radius of the profile around each section
constexpr double kBlur = .12;          // width of the kernel that blends sections
// A blend shape closes the lids at a section of the eye's opening if the shape narrows the gap
// between the lids there by at least this fraction of the eyeball's radius.
constexpr double kMinClosed = 0.05;
/// A shape closes the lids only if at most this fraction of the template's gap at rest remains.
constexpr double kMaxRemaining = 0.4;
// Smallest allowed distance between a lid and the eyeball, as a fraction of the eyeball's radius. A
// lid may be nearer to the eyeball if the lid is nearer on the template with the blend shape
// applied, or on the face at rest.
constexpr double kMargin = 0.004;
/// Largest allowed depth of skin in the eyeball, as a fraction of the eyeball's radius. Skin that
/// is deeper at rest may stay that deep.
constexpr double kDeepest = 0.0125;
constexpr double kSomeDeeper = 0.002;  // depth beyond the limit that is tolerated
/// Corrected lids may close farther than the template's lids, by at most this fraction of the
/// eyeball's radius, so that the skin between two sections closes too.
constexpr double kMaxExtraClosing = 0.02;
constexpr int kSteps = 8;
constexpr double kClosed = 0.016;  // a gap that counts as closed

/// Returns the position of one rim vertex of the upper or lower lid: the vertex whose coordinate
/// along the lid opening is nearest to `at`.
/// \param shape  positions of the template's vertices with the blend shape applied, #V by 3
/// \param along  unit vector along the lid opening
Eigen::Vector3d rim_at(const TemplateEye& eye, const Positions& shape, bool upper, double at,
                       const Eigen::Vector3d& along) {
  double nearest = std::numeric_limits<double>::max();
  Eigen::Vector3d found = eye.ball.centre();
  for (std::size_t r = 0; r < eye.lids.rim.size(); ++r) {
    if (eye.lids.is_upper[r] != upper) continue;
    const Eigen::Vector3d point = row3(shape, eye.lids.vertices[eye.lids.rim[r]]);
    const double distance = std::abs(point.dot(along) - at);
    if (distance >= nearest) continue;
    nearest = distance;
    found = point;
  }
  return found;
}

}  // namespace

void mark_lid_sides(const TemplateEye& eye, const Positions& neutral,
                    std::vector<signed char>& side) {
  for (const std::uint32_t v : eye.skin_vertices) {
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t r = 0; r < eye.lids.rim.size(); ++r) {
      const std::uint32_t rim = eye.lids.vertices[eye.lids.rim[r]];
      const double distance = (row3(neutral, v) - row3(neutral, rim)).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      side[v] = eye.lids.is_upper[r] ? 1 : -1;
    }
  }
}

BallRadii::Gap FaceEye::gap_at(const Eigen::Vector3d& point) const {
  const BallRadii::Gap found = ball->gap_at(motion.apply_inverse(point) - ball->centre());
  return {motion.scale * found.gap, motion.apply_to_direction(found.normal) / motion.scale};
}

FaceEye make_face_eye(const TemplateEye& eye, const BallRadii& ball, const RigidMotion& motion,
                      const Positions& mesh) {
  FaceEye there{&ball, motion};
  for (const std::uint32_t v : eye.skin_vertices)
    there.rest_gaps.push_back(there.gap_at(row3(mesh, v)).gap);
  return there;
}

LidClosure::LidClosure(const TemplateEye& eye, const Adjacency& adjacency, const Positions& neutral,
                       const Displacements& shape, const HeadAxes& axes)
    : axes_(axes), radius_(eye.ball.radius()) {
  if (eye.lids.rim.empty()) return;
  add_sections(eye, adjacency, neutral, shape, axes);
  const FaceEye at_rest{&eye.ball, {}};
  const Eigen::Vector3d along = axes.side();
  for (std::uint32_t i = 0; i < eye.skin_vertices.size(); ++i) {
    const std::uint32_t v = eye.skin_vertices[i], row = index_in_list(shape.vertices, v);
    if (row == kNoIndex) continue;
    const Eigen::Vector3d before = row3(neutral, v), after = before + row3(shape.moves, row);
    const double gap_before = at_rest.gap_at(before).gap, gap_after = at_rest.gap_at(after).gap;
    const Eigen::Vector3d from = before - eye.ball.centre();
    LidVertex lid{row, v, i, 0, 0};
    lid.eyeball_weight = smooth_step(kNoCorrectionGap * radius_, kFullCorrectionGap * radius_,
                                     std::min(std::abs(gap_before), std::abs(gap_after)));
    if (!sections_.empty())
      lid.closing_weight =
          smooth_step(kNoMotionRadius * radius_, kFullMotionRadius * radius_, from.norm());
    if (lid.closing_weight > 0 || lid.eyeball_weight > 0) lid_vertices_.push_back(lid);
  }
  move_profile_vertices_to_front();
  for (const LidVertex& lid : lid_vertices_) {
    const double at = (row3(neutral, lid.vertex) + row3(shape.moves, lid.row)).dot(along);
    const std::size_t first = section_weights_.size();
    double sum = 0;
    for (const LidSection& section : sections_) {
      const double x = (at - section.along_opening) / (kBlur * radius_);
      section_weights_.push_back(1 / ((x * x + 1) * (x * x + 1)));
      sum += section_weights_.back();
    }
    for (std::size_t p = first; p < section_weights_.size(); ++p)
      section_weights_[p] *= lid.closing_weight / sum;
  }
}

/// Moves the lid vertices that belong to profiles to the front of lid_vertices_. While `fit_lids`
/// searches for the sections' gains (see move_lids), it moves only these vertices.
void LidClosure::move_profile_vertices_to_front() {
  std::set<std::uint32_t> rows;
  for (const LidSection& section : sections_) {
    for (const auto* points : {&section.lower_profile, &section.upper_profile}) {
      for (const ProfilePoint& point : *points) rows.insert({point.row_a, point.row_b});
    }
  }
  const auto rest =
      std::stable_partition(lid_vertices_.begin(), lid_vertices_.end(),
                            [&](const LidVertex& lid) { return rows.contains(lid.row); });
  profile_vertex_count_ = static_cast<std::size_t>(rest - lid_vertices_.begin());
}

void LidClosure::add_sections(const TemplateEye& eye, const Adjacency& adjacency,
                              const Positions& neutral, const Displacements& shape,
                              const HeadAxes& axes) {
  // The template with the blend shape applied.
  Positions closed = neutral;
  shape.add_to(closed);
  const Eigen::Vector3d along = axes.side();
  std::vector<signed char> sides(static_cast<std::size_t>(neutral.rows()), 0);
  mark_lid_sides(eye, neutral, sides);
  const std::vector<double> side(sides.begin(), sides.end());
  // Place cross-sections of the lids along the opening, between the corners of the eye.
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const std::uint32_t r : eye.lids.rim) {
    const double at = row3(neutral, eye.lids.vertices[r]).dot(along);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  for (std::size_t k = 0; k < kSections; ++k) {
    const double at = low + (high - low) * (static_cast<double>(k) + 0.5) / kSections;
    const Eigen::Vector3d middle =
        (rim_at(eye, closed, true, at, along) + rim_at(eye, closed, false, at, along)) / 2;
    // Cut both lids with a plane across the eye's opening, on the template with the blend shape
    // applied. Keep this section if the blend shape closes the lids enough there.
    GapSection cut{middle + (at - middle.dot(along)) * along, axes.up, along, {}, {}};
    cut_profiles(adjacency, closed, eye.skin_vertices, side, kProfile * radius_, cut);
    if (cut.low_profile.empty() || cut.high_profile.empty()) continue;
    const double before = cut.gap(neutral), after = cut.gap(closed);
    if (before - after < kMinClosed * radius_ || after > kMaxRemaining * before) continue;
    LidSection section{{}, {}, at, before - after};
    const auto add = [&](const std::vector<EdgePoint>& points, std::vector<ProfilePoint>& to) {
      for (const EdgePoint& point : points) {
        to.push_back({point, index_in_list(shape.vertices, point.a),
                      index_in_list(shape.vertices, point.b)});
      }
    };
    add(cut.low_profile, section.lower_profile);
    add(cut.high_profile, section.upper_profile);
    sections_.push_back(std::move(section));
  }
}

std::vector<std::uint32_t> LidClosure::adjustable_rows() const {
  std::vector<std::uint32_t> rows;
  for (const LidVertex& lid : lid_vertices_) rows.push_back(lid.row);
  return rows;
}

LidClosure::EyeAxes LidClosure::eye_axes(const RigidMotion& face_motion) const {
  return {face_motion.apply_to_direction(axes_.side()) / face_motion.scale,
          face_motion.apply_to_direction(axes_.up) / face_motion.scale};
}

LidClosure::LidTargets LidClosure::measure_targets(const Positions& mesh, const FaceEye& eye,
                                                   const RigidMotion& face_motion,
                                                   const Positions& moves) const {
  LidTargets targets;
  if (!sections_.empty()) targets.gaps = measure_gaps(eye_axes(face_motion), mesh, moves);
  for (Gap& gap : targets.gaps)
    gap = {gap.section_gap / face_motion.scale, gap.vertical_gap / face_motion.scale};
  for (const LidVertex& lid : lid_vertices_) {
    const double after = eye.gap_at(row3(mesh, lid.vertex) + row3(moves, lid.row)).gap;
    targets.ball_distances.push_back(after / face_motion.scale);
    targets.distance_changes.push_back((after - eye.rest_gaps[lid.skin_index]) / face_motion.scale);
  }
  return targets;
}

LidClosure::LidTargets LidClosure::mean_targets(std::span<const LidTargets> targets,
                                                std::span<const ShapeSetShare> shares) {
  LidTargets mean;
  mean.gaps.assign(targets.front().gaps.size(), {0, 0});
  mean.ball_distances.assign(targets.front().ball_distances.size(), 0);
  mean.distance_changes = mean.ball_distances;
  for (const ShapeSetShare& of_set : shares) {
    const LidTargets& one = targets[of_set.set];
    for (std::size_t p = 0; p < mean.gaps.size(); ++p) {
      mean.gaps[p].section_gap += of_set.blend_weight * one.gaps[p].section_gap;
      mean.gaps[p].vertical_gap += of_set.blend_weight * one.gaps[p].vertical_gap;
    }
    for (std::size_t i = 0; i < mean.ball_distances.size(); ++i) {
      mean.ball_distances[i] += of_set.blend_weight * one.ball_distances[i];
      mean.distance_changes[i] += of_set.blend_weight * one.distance_changes[i];
    }
  }
  return mean;
}

LidClosure::RimPoint LidClosure::rim_point(const std::vector<ProfilePoint>& points, double sign,
                                           const EyeAxes& axes, const Positions& face,
                                           const Positions& moves) {
  RimPoint rim{0, -std::numeric_limits<double>::max()};
  for (const ProfilePoint& point : points) {
    Eigen::Vector3d at = (1 - point.edge.fraction) * row3(face, point.edge.a) +
                         point.edge.fraction * row3(face, point.edge.b);
    if (point.row_a != kNoIndex) at += (1 - point.edge.fraction) * row3(moves, point.row_a);
    if (point.row_b != kNoIndex) at += point.edge.fraction * row3(moves, point.row_b);
    const double height = sign * at.dot(axes.up);
    if (height > rim.height) rim = {at.dot(axes.along), height};
  }
  return {rim.along_opening, sign * rim.height};
}

std::vector<LidClosure::Gap> LidClosure::measure_gaps(const EyeAxes& axes, const Positions& face,
                                                      const Positions& moves) const {
  std::vector<RimPoint> low;
  for (const LidSection& section : sections_)
    low.push_back(rim_point(section.lower_profile, 1, axes, face, moves));
  std::vector<RimPoint> sorted = low;
  std::sort(sorted.begin(), sorted.end(),
            [](const RimPoint& a, const RimPoint& b) { return a.along_opening < b.along_opening; });
  std::vector<Gap> gaps;
  for (std::size_t p = 0; p < sections_.size(); ++p) {
    const RimPoint high = rim_point(sections_[p].upper_profile, -1, axes, face, moves);
    const auto next =
        std::lower_bound(sorted.begin(), sorted.end(), high.along_opening,
                         [](const RimPoint& rim, double at) { return rim.along_opening < at; });
    double below = next == sorted.end() ? sorted.back().height : next->height;
    if (next != sorted.begin() && next != sorted.end()) {
      const RimPoint& before = *std::prev(next);
      const double t = (high.along_opening - before.along_opening) /
                       (next->along_opening - before.along_opening);
      below = (1 - t) * before.height + t * next->height;
    }
    gaps.push_back({high.height - low[p].height, high.height - below});
  }
  return gaps;
}

void LidClosure::move_lids(std::size_t count, const Eigen::Vector3d& up,
                           const Positions& unscaled_moves, std::span<const double> gains,
                           Positions& moves) const {
  for (std::size_t i = 0; i < count; ++i) {
    const LidVertex& lid = lid_vertices_[i];
    const Eigen::Vector3d move = row3(unscaled_moves, lid.row);
    const double gain = fixed_order_dot(section_weights(i), gains);
    moves.row(lid.row) = (move + gain * move.dot(up) * up).transpose();
  }
}

double LidClosure::min_ball_distance(std::size_t lid, double rest, double scale,
                                     const LidTargets& targets) const {
  const double of_shape =
      std::max(scale * targets.ball_distances[lid], -kDeepest * scale * radius_);
  return std::min({rest, of_shape, kMargin * scale * radius_});
}

void LidClosure::keep_outside_eyeball(std::size_t count, const Positions& face, const FaceEye& eye,
                                      double scale, const LidTargets& targets,
                                      Positions& moves) const {
  for (std::size_t i = 0; i < count; ++i) {
    const LidVertex& lid = lid_vertices_[i];
    if (lid.eyeball_weight == 0) continue;
    const BallRadii::Gap now = eye.gap_at(row3(face, lid.vertex) + row3(moves, lid.row));
    const double rest = eye.rest_gaps[lid.skin_index];
    const double wanted = std::max(rest + scale * targets.distance_changes[i],
                                   min_ball_distance(i, rest, scale, targets));
    moves.row(lid.row) += (lid.eyeball_weight * (wanted - now.gap) * now.normal).transpose();
  }
}

bool LidClosure::move_out_of_eyeball(const Positions& face, const FaceEye& eye,
                                     const RigidMotion& face_motion, const LidTargets& targets,
                                     Positions& moves) const {
  const double tolerance = kSomeDeeper * face_motion.scale * radius_;
  bool is_outside = true;
  for (std::size_t i = 0; i < lid_vertices_.size(); ++i) {
    const LidVertex& lid = lid_vertices_[i];
    if (lid.eyeball_weight == 0) continue;
    const double least =
        min_ball_distance(i, eye.rest_gaps[lid.skin_index], face_motion.scale, targets);
    const BallRadii::Gap now = eye.gap_at(row3(face, lid.vertex) + row3(moves, lid.row));
    if (now.gap >= least) continue;
    // The correction below moves the vertex by the missing distance times `eyeball_weight`. So the
    // vertex counts as inside the eyeball only if this product reaches the tolerance.
    is_outside = is_outside && lid.eyeball_weight * (least - now.gap) < tolerance;
    moves.row(lid.row) += (lid.eyeball_weight * (least - now.gap) * now.normal).transpose();
  }
  return is_outside;
}

double LidClosure::largest_open_gap(const Positions& face, const RigidMotion& face_motion,
                                    const LidTargets& targets, const Positions& moves) const {
  const std::vector<Gap> now = measure_gaps(eye_axes(face_motion), face, moves);
  double open = 0;
  for (std::size_t p = 0; p < now.size(); ++p) {
    const double allowed = std::max(targets.gaps[p].vertical_gap / radius_, kClosed);
    open = std::max(open, now[p].vertical_gap / (face_motion.scale * radius_) - allowed);
  }
  return open;
}

void LidClosure::restore_closure(const Positions& face, const RigidMotion& face_motion,
                                 const LidTargets& targets, Positions& moves) const {
  const EyeAxes axes = eye_axes(face_motion);
  std::vector<double> gains =
      gap_excesses(measure_gaps(axes, face, moves), targets, face_motion.scale);
  for (std::size_t p = 0; p < sections_.size(); ++p) {
    gains[p] =
        std::max(gains[p], 0.0) / (face_motion.scale * sections_[p].gap_reduction_on_template);
  }
  const Positions unscaled_moves = moves;
  move_lids(lid_vertices_.size(), axes.up, unscaled_moves, gains, moves);
}

std::vector<double> LidClosure::gap_excesses(const std::vector<Gap>& now, const LidTargets& targets,
                                             double scale) {
  std::vector<double> missing;
  for (std::size_t p = 0; p < now.size(); ++p) {
    const Gap& wanted = targets.gaps[p];
    missing.push_back(std::max(now[p].section_gap - scale * wanted.section_gap,
                               now[p].vertical_gap - scale * std::max(wanted.vertical_gap, 0.0)));
  }
  return missing;
}

void LidClosure::fit_lids(const Positions& face, const FaceEye& eye, const RigidMotion& face_motion,
                          const LidTargets& targets, Positions& moves) const {
  const EyeAxes axes = eye_axes(face_motion);
  if (sections_.empty()) {
    return keep_outside_eyeball(lid_vertices_.size(), face, eye, face_motion.scale, targets, moves);
  }
  const Positions unscaled_moves = moves;
  std::vector<double> gains(sections_.size(), 0.0);
  double sure = 0;
  // For each section, find the gain that closes the gap between the lids at this section. A gain is
  // a relative increase of the lids' vertical movement (see move_lids). The iteration is the chord
  // method (Newton's method with a fixed slope). The slope follows from an assumption: a gain of 1
  // narrows the gap as much as the shape does on the template.
  for (int step = 0; step < kSteps; ++step) {
    if (step > 0) move_lids(profile_vertex_count_, axes.up, unscaled_moves, gains, moves);
    keep_outside_eyeball(profile_vertex_count_, face, eye, face_motion.scale, targets, moves);
    const std::vector<double> missing =
        gap_excesses(measure_gaps(axes, face, moves), targets, face_motion.scale);
    if (step == 0) {
      for (const double gap : missing) sure = std::max(sure, std::abs(gap) / 2);
      sure = std::min(sure, kMaxExtraClosing * face_motion.scale * radius_);
    }
    for (std::size_t p = 0; p < sections_.size(); ++p) {
      gains[p] +=
          (missing[p] + sure) / (face_motion.scale * sections_[p].gap_reduction_on_template);
    }
  }
  move_lids(lid_vertices_.size(), axes.up, unscaled_moves, gains, moves);
  keep_outside_eyeball(lid_vertices_.size(), face, eye, face_motion.scale, targets, moves);
}

}  // namespace crowdface
