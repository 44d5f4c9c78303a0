// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/eye_socket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/quadratic_program.h"

namespace crowdface {
namespace {

/// Skin nearer to the eyeball than this distance belongs to the lids. The distance is a fraction of
/// the eyeball's radius (about 12 mm).
constexpr double kLidReach = 0.3;
/// Smallest cosine of the angle between the front direction of the head and the direction from the
/// eyeball's centre to a rim vertex.
constexpr double kMinFront = 0.35;
/// Number of sectors around the axis of the eye; the rim has at most one vertex in each sector.
constexpr std::size_t kRimSectors = 60;
/// Largest number of lid vertices that are used; more vertices are subsampled evenly.
constexpr std::size_t kMaxLidVertices = 2500;

/// kMeanGapWeight: weight of the error of a lid's mean gap, relative to the mean square error of
/// the gaps at the rim. kMeanGapTolerance: tolerance of the mean gap, as a fraction of the radius;
/// about 0.05 mm.
constexpr double kMeanGapWeight = 20, kMeanGapTolerance = 0.004;
/// Costs of translation (kTranslationCost) and of a change of size (kBallSizeCost), relative to the
/// cost of errors of the gaps.
constexpr double kTranslationCost = 0.02, kBallSizeCost = 0.2;
/// Largest decrease (kMaxBallShrink) and increase (kMaxBallGrowth) of an eyeball's size, as
/// fractions of the size.
constexpr double kMaxBallShrink = 0.08, kMaxBallGrowth = 0.03;
/// Gap that is kept at lid vertices that are outside the eyeball in all heads, as a fraction of the
/// radius; about 0.025 mm.
constexpr double kMargin = 0.002;
/// Smallest gap of lid vertices that count as outside the eyeball, as a fraction of the radius. It
/// is negative: vertices up to 0.04 mm inside the eyeball also count as outside.
constexpr double kMinOutsideGap = -0.003;
/// Lid vertices farther from the eyeball than this fraction of the radius are not checked, because
/// one step moves the eyeball by less. kFarFirst applies to the first step, kFarLater to all later
/// steps.
constexpr double kFarFirst = 0.1, kFarLater = 0.04;
/// The iteration ends with the first step that translates by less than this fraction of the radius.
constexpr double kDoneShift = 1e-3;
/// Penalties for violated constraints, as multiples of the radius.
/// - kNewLidPenalty is for lid vertices that are outside the eyeball in all heads: such a vertex is
///   now inside the eyeball or too close to it.
/// - kMeanGapPenalty: the mean gap between a lid and the eyeball differs too much from the mean gap
///   in the target.
/// - kDeepLidPenalty is for lid vertices that are inside the eyeball in at least one head: such a
///   vertex is now deeper inside than in every head.
constexpr double kNewLidPenalty = 100, kMeanGapPenalty = 10, kDeepLidPenalty = 1;

/// Unknowns of an optimisation step of an eyeball. All unknowns are lengths.
enum BallUnknown : std::size_t {
  kBallShift = 0,
  kBallSize = 3,
  kMeanGapSlack,
  kNewLidSlack,
  kDeepLidSlack,
  kBallUnknowns
};

/// The plane is divided into kRimSectors equal sectors. Returns the index of the sector that
/// contains the direction (x, y).
std::size_t sector(double x, double y) {
  constexpr double kTurn = 6.283185307179586, kRound = 1e9;
  const double turn = std::round((std::atan2(y, x) / kTurn + 0.5) * kRound) / kRound;
  const auto number = static_cast<std::size_t>(turn * static_cast<double>(kRimSectors));
  return std::min(number, kRimSectors - 1);
}

}  // namespace

Lids find_lids(const Positions& positions, const PointGrid& eyeball, const Eigen::Vector3d& centre,
               double radius, const HeadAxes& axes, std::span<const std::uint32_t> skin) {
  const double reach = kLidReach * radius;
  const Eigen::Vector3d side = axes.side();
  struct Innermost {
    std::uint32_t vertex = kNoIndex;
    double cosine = kMinFront;
  };
  std::array<Innermost, kRimSectors> innermost;
  std::vector<std::uint32_t> near;
  for (const std::uint32_t v : skin) {
    const Eigen::Vector3d point = positions.row(v).transpose();
    const Eigen::Vector3d from = point - centre;
    const double distance = from.norm();
    if (distance > radius + 2 * reach || from.dot(axes.front) < -reach) continue;
    if (eyeball.nearest(point, reach).vertex == kNoIndex) continue;
    near.push_back(v);
    const double cosine = from.dot(axes.front) / distance;
    Innermost& best = innermost[sector(from.dot(side), from.dot(axes.up))];
    if (cosine > best.cosine) best = {v, cosine};
  }
  // Keep all rim vertices, and subsample the other lid vertices.
  Lids lids;
  std::vector<std::uint32_t> rim;
  for (const Innermost& best : innermost) {
    if (best.vertex != kNoIndex) rim.push_back(best.vertex);
  }
  std::ranges::sort(rim);
  const std::vector<std::uint32_t> some = evenly_spaced_items(near, kMaxLidVertices);
  std::set_union(some.begin(), some.end(), rim.begin(), rim.end(),
                 std::back_inserter(lids.vertices));
  for (const std::uint32_t v : rim) {
    const auto at = std::ranges::lower_bound(lids.vertices, v);
    lids.rim.push_back(static_cast<std::uint32_t>(at - lids.vertices.begin()));
    lids.is_upper.push_back((row3(positions, v) - centre).dot(axes.up) > 0);
  }
  return lids;
}

EyeSocket::EyeSocket(Lids lids, std::vector<BallRadii> ball_radii, const std::vector<Head>& heads)
    : lids_(std::move(lids)),
      ball_radii_(std::move(ball_radii)),
      smallest_gaps_(lids_.vertices.size(), 1e300),
      rim_indices_(lids_.vertices.size(), kNoIndex) {
  for (std::size_t r = 0; r < lids_.rim.size(); ++r) {
    rim_indices_[lids_.rim[r]] = static_cast<std::uint32_t>(r);
  }
  for (std::size_t h = 0; h < heads.size(); ++h) {
    std::vector<double>& gaps = gaps_.emplace_back(lids_.rim.size());
    for (std::size_t i = 0; i < lids_.vertices.size(); ++i) {
      const Eigen::Vector3d point = heads[h].positions.row(lids_.vertices[i]).transpose();
      const double gap = ball_radii_[h].gap_at(point - ball_radii_[h].centre()).gap;
      smallest_gaps_[i] = std::min(smallest_gaps_[i], gap);
      if (rim_indices_[i] != kNoIndex) gaps[rim_indices_[i]] = gap;
    }
  }
}

RigidMotion EyeSocket::fit(std::size_t target, const RigidMotion& skin_motion,
                           const Positions& face) const {
  return iterate_steps(target, skin_motion, skin_motion, SizeMode::kFree, face);
}

RigidMotion EyeSocket::fit_translation(std::size_t target, const RigidMotion& skin_motion,
                                       const RigidMotion& scaled_motion,
                                       const Positions& face) const {
  return iterate_steps(target, skin_motion, scaled_motion, SizeMode::kKept, face);
}

RigidMotion EyeSocket::iterate_steps(std::size_t target, const RigidMotion& skin_motion,
                                     RigidMotion motion, SizeMode size_mode,
                                     const Positions& face) const {
  constexpr int kSteps = 4;
  if (lids_.rim.empty()) return motion;
  std::vector<LidPoint> lids;
  lids.reserve(lids_.vertices.size());
  for (std::uint32_t i = 0; i < lids_.vertices.size(); ++i) {
    lids.push_back({face.row(lids_.vertices[i]).transpose(), i});
  }
  for (int k = 0; k < kSteps; ++k) {
    const RigidMotion next =
        step(target, skin_motion, motion, k == 0 ? kFarFirst : kFarLater, size_mode, lids);
    const double change = (next.moved_pivot - motion.moved_pivot).norm();
    motion = next;
    if (change < kDoneShift * ball_radii_[target].radius()) break;
  }
  return motion;
}

RigidMotion EyeSocket::step(std::size_t target, const RigidMotion& skin_motion,
                            const RigidMotion& motion, double far, SizeMode size_mode,
                            std::vector<LidPoint>& lids) const {
  const BallRadii& map = ball_radii_[target];
  const double radius = motion.scale * map.radius();
  // If a lid vertex is farther from the eyeball's centre than this radius, its gap (the distance
  // from the eyeball's surface) is larger than `far` · `radius`. The gap is measured along the
  // normal of the eyeball, so it is a little smaller than the distance along the ray from the
  // centre. The factor 1.5 allows for this difference.
  const double outside = motion.scale * map.max_radius() + 1.5 * far * radius;
  const Eigen::Vector3d centre = motion.apply(map.centre());
  const Eigen::Vector3d shifted = centre - skin_motion.apply(map.centre());
  const double grown = (motion.scale / skin_motion.scale - 1) * radius;
  const auto rim = static_cast<double>(lids_.rim.size());
  QuadraticProgram program(kBallUnknowns);
  struct {
    QuadraticProgram::Vector a = {};
    double missing = 0, count = 0;
  } mean[2];

  std::size_t kept = 0;
  // Add one constraint per lid vertex. Lid vertices on the rim also get a target: the distance
  // that they had from the eyeball on the target head.
  for (const LidPoint& lid : lids) {
    const std::uint32_t r = rim_indices_[lid.index];
    const Eigen::Vector3d from = lid.point - centre;
    if (r == kNoIndex && from.squaredNorm() > outside * outside) continue;
    BallRadii::Gap gap = map.gap_at(motion.apply_inverse(lid.point) - map.centre());
    gap.gap *= motion.scale;
    if (r == kNoIndex && gap.gap > far * radius) continue;
    lids[kept++] = lid;
    const Eigen::Vector3d normal = motion.apply_to_direction(gap.normal) / motion.scale;
    // A translation by x changes the gap by −x · normal.
    QuadraticProgram::Vector a = {-normal.x(), -normal.y(), -normal.z()};
    if (size_mode == SizeMode::kFree) {
      a[kBallSize] = -normal.dot(lid.point - gap.gap * normal - centre) / radius;
    }
    if (r != kNoIndex) {
      const double missing = gaps_[target][r] - gap.gap;
      program.add_target(a, missing, 1 / rim);
      auto& of = mean[lids_.is_upper[r] ? 1 : 0];
      for (std::size_t i = 0; i < kMeanGapSlack; ++i) of.a[i] += a[i];
      of.missing += missing;
      of.count += 1;
    }
    const double least = smallest_gaps_[lid.index];
    const bool never = least > kMinOutsideGap * map.radius();
    a[never ? kNewLidSlack : kDeepLidSlack] = 1;
    program.add_lower_bound(a, (never ? kMargin * radius : motion.scale * least) - gap.gap);
  }
  lids.resize(kept);  // Later steps skip the lid vertices that are too far from the eyeball.
  // Keep the mean gap between each lid's rim and the eyeball, within a tolerance.
  for (auto& of : mean) {
    if (of.count == 0) continue;
    for (double& value : of.a) value /= of.count;
    const double missing = of.missing / of.count;
    program.add_target(of.a, missing, kMeanGapWeight);
    QuadraticProgram::Vector less = of.a;
    for (double& value : less) value = -value;
    of.a[kMeanGapSlack] = less[kMeanGapSlack] = 1;
    program.add_lower_bound(of.a, missing - kMeanGapTolerance * radius);
    program.add_lower_bound(less, -missing - kMeanGapTolerance * radius);
  }
  // Keep the total translation of the eyeball small.
  for (std::size_t i = 0; i < 3; ++i) {
    program.add_target(kBallShift + i, -shifted(static_cast<Index>(i)), kTranslationCost);
  }
  // Keep the total change of the eyeball's size small.
  program.add_target(kBallSize, size_mode == SizeMode::kFree ? -grown : 0, kBallSizeCost);
  if (size_mode == SizeMode::kFree) {
    program.add_bounds(kBallSize, -kMaxBallShrink * radius - grown,
                       kMaxBallGrowth * radius - grown);
  }
  program.add_slack(kMeanGapSlack, kMeanGapPenalty * radius);
  program.add_slack(kNewLidSlack, kNewLidPenalty * radius);
  program.add_slack(kDeepLidSlack, kDeepLidPenalty * radius);
  const QuadraticProgram::Vector x = program.solve(1e-5 * radius);
  return nudged(motion, centre, {x[0], x[1], x[2]}, {0, 0, 0},
                size_mode == SizeMode::kFree ? x[kBallSize] / radius : 0);
}

}  // namespace crowdface
