// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/alignment_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"

namespace crowdface {
namespace {

// Well-aligned heads of different people still differ by a few degrees in pose and by a few percent
// in size. If two heads differ by more, their coordinate frames differ.
constexpr double kMaxDegrees = 6;
constexpr double kMaxShift = 0.06;
constexpr double kMaxScale = 1.3;
constexpr double kOtherUnit = 5;      // ratio of sizes; beyond it, the head is in another unit
constexpr double kMaxTurn = 45;       // degrees; a larger rotation cannot be blended as detail
constexpr double kTimesNearer = 2.5;  // ratio of distances; beyond it, the head is mirrored
constexpr Index kPoints = 2000;

/// Returns about `most` skin vertices, evenly spaced by index.
std::vector<Index> spaced_skin_vertices(const Components& components, Index most) {
  const std::uint32_t skin = components.largest();
  const Index size = components.sizes[skin];
  const Index step = std::max<Index>(1, size / most);
  std::vector<Index> chosen;
  Index seen = 0;
  for (Index i = 0; i < static_cast<Index>(components.component_of_vertex.size()); ++i) {
    if (components.component_of_vertex[static_cast<std::size_t>(i)] != skin) continue;
    if (seen++ % step == 0) chosen.push_back(i);
  }
  return chosen;
}

double radius(const Positions& points) {
  const Eigen::RowVector3d middle = points.colwise().mean();
  return std::sqrt((points.rowwise() - middle).rowwise().squaredNorm().mean());
}

/// Mean squared distance between the vertices of a head and of a reference, after the head is
/// aligned with the reference.
double misfit(const Positions& head, const Positions& reference) {
  const Similarity fit = fit_similarity(head, reference, ScaleFit::kUniform);
  return (fit.apply(head) - reference).rowwise().squaredNorm().mean();
}

bool is_mirrored(const Positions& head, const Positions& reference) {
  const Positions mirrored = head * Eigen::Vector3d(-1, 1, 1).asDiagonal();
  return kTimesNearer * kTimesNearer * misfit(mirrored, reference) < misfit(head, reference);
}

HeadPose pose_against(const Positions& head, const Positions& reference) {
  const Similarity fit = fit_similarity(head, reference, ScaleFit::kUniform);
  const double size = radius(reference);
  HeadPose pose;
  pose.angle_degrees = fit.angle_degrees();
  pose.scale = fit.scale > 0 ? 1 / fit.scale : 0;
  if (size > 0) {
    pose.relative_shift = (head.colwise().mean() - reference.colwise().mean()).norm() / size;
  }
  return pose;
}

bool is_of_other_size(const HeadPose& pose) {
  return pose.scale > kMaxScale || pose.scale < 1 / kMaxScale;
}

bool is_off(const HeadPose& pose) {
  return pose.angle_degrees > kMaxDegrees || pose.relative_shift > kMaxShift ||
         is_of_other_size(pose);
}

double badness(const HeadPose& pose) {
  const double scale = std::max(pose.scale, 1 / std::max(pose.scale, 1e-9));
  return pose.angle_degrees / kMaxDegrees + pose.relative_shift / kMaxShift +
         (scale - 1) / (kMaxScale - 1);
}

}  // namespace

std::vector<HeadPose> head_poses(const HeadSet& heads, const Components& components) {
  const std::vector<Index> chosen = spaced_skin_vertices(components, kPoints);
  const std::size_t count = heads.heads.size();
  if (chosen.size() < 3) return std::vector<HeadPose>(count);
  std::vector<Positions> points;
  for (const Head& head : heads.heads) points.emplace_back(head.positions(chosen, kAllColumns));
  // The reference is the head whose median disagreement with the other heads is smallest, so that
  // one stray head does not make the other heads look wrong.
  std::vector<double> disagreement(count);
  parallel_for_each(count, [&](std::size_t r) {
    std::vector<double> against;
    for (const Positions& head : points) against.push_back(badness(pose_against(head, points[r])));
    disagreement[r] = nth_smallest(std::move(against), count / 2);
  });
  const auto reference =
      static_cast<std::size_t>(std::ranges::min_element(disagreement) - disagreement.begin());
  std::vector<HeadPose> poses;
  for (const Positions& head : points) {
    poses.push_back(pose_against(head, points[reference]));
    poses.back().is_mirrored = is_mirrored(head, points[reference]);
  }
  return poses;
}

std::string objection_to_pose(const HeadPose& pose, const std::string& head) {
  if (pose.is_mirrored) {
    return concat(
        "head ", head,
        " is mirrored: left and right are swapped relative to the others; mirror it back (scale "
        "it by -1 along one axis and flip its polygons; faces.align: none skips this check)");
  }
  if (pose.scale > kOtherUnit || pose.scale < 1 / kOtherUnit) {
    return concat("head ", head, ": expected heads in one unit, found ",
                  format_fixed(pose.scale, 2),
                  " times the size of the others; export this head in the unit of the others "
                  "(faces.align: none skips this check)");
  }
  return {};
}

bool needs_rigid_alignment(const HeadSet& heads, const Components& components) {
  const std::vector<HeadPose> poses = head_poses(heads, components);
  return std::ranges::any_of(poses, is_off) && std::ranges::none_of(poses, is_of_other_size);
}

std::vector<std::string> align_heads(HeadSet& heads, const Components& components, Align align) {
  if (align == Align::kNone) return {};
  if (align == Align::kRigid) {
    const std::vector<Index> chosen =
        spaced_skin_vertices(components, std::max<Index>(heads.topology.vertex_count, 1));
    const Positions reference = heads.heads[0].positions(chosen, kAllColumns);
    if (chosen.size() >= 3) {
      parallel_for_each(heads.heads.size() - 1, [&](std::size_t h) {
        Positions& positions = heads.heads[h + 1].positions;
        const Positions points = positions(chosen, kAllColumns);
        positions = fit_similarity(points, reference, ScaleFit::kRigid).apply(positions);
      });
    }
  }
  std::vector<std::string> warnings;
  const std::vector<HeadPose> poses = head_poses(heads, components);
  for (std::size_t h = 0; h < poses.size(); ++h) {
    const std::string objection = objection_to_pose(poses[h], heads.heads[h].name);
    if (!objection.empty()) throw InvalidInput(objection);
    if (!is_off(poses[h])) continue;
    if (align == Align::kCheck && poses[h].angle_degrees > kMaxTurn) {
      throw InvalidInput(concat("head ", heads.heads[h].name, " is turned by ",
                                format_fixed(poses[h].angle_degrees, 1),
                                " degrees relative to the others; faces.align: rigid turns it "
                                "back, faces.align: none skips this check"));
    }
    warnings.push_back(
        concat("head ", heads.heads[h].name, " is not aligned with the others: turned by ",
               format_fixed(poses[h].angle_degrees, 1), " degrees, moved by ",
               format_fixed(100 * poses[h].relative_shift, 1), " % of its size, ",
               format_fixed(poses[h].scale, 2),
               " times as large; blending treats this difference as detail",
               is_of_other_size(poses[h]) ? " (a different size is not corrected; check its units)"
               : align == Align::kCheck   ? " (faces.align: rigid turns and moves it back)"
                                          : ""));
  }
  return warnings;
}

}  // namespace crowdface
