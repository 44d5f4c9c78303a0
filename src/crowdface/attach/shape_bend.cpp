// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/shape_bend.h"

#include <algorithm>
#include <array>
#include <compare>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {
namespace {

/// Minimum radius of the patch of skin around a root. Where the skin has few vertices, the radius
/// is larger.
constexpr double kMinPatchRadiusMm = 3;
/// The anchor of an attachment's point is the centre of the point's patch. The anchor lies at the
/// point's root on the skin, but at most at this distance from the point. If the root is farther
/// away from the point, the anchor lies off the skin and the patch is larger.
constexpr double kMaxAnchorShiftMm = 10;
/// A patch contains only vertices whose distance from the root along the surface is at most
/// kMaxSurfaceRatio times the patch's radius.
constexpr double kMaxSurfaceRatio = 1.5;
/// If fewer than kMinPatchVertices vertices of a patch are near the root along the surface, the
/// patch keeps all its vertices, because a few vertices do not determine a rotation reliably.
constexpr std::size_t kMinPatchVertices = 6;

/// The root of an attachment's point is the point of the skin that it follows. The root is
/// ambiguous if two parts of the skin, for example both lips, are about equally near to the
/// attachment's point. The test uses a sphere around the attachment's point. The radius of the
/// sphere is the distance to the nearest skin vertex N plus kAmbiguousMm. The root is ambiguous if
/// the sphere contains a skin vertex that is far from N along the surface: farther than kFarRatio
/// times the radius.
constexpr double kAmbiguousMm = 2, kFarRatio = 4;

/// Finds the root of each point of an attachment: the point of the skin that is nearest to this
/// point. Starts each search at the root of a neighbouring point of the attachment.
class RootSearch {
 public:
  RootSearch(const FittedSkin& skin, const Adjacency& adjacency, const Topology& topology,
             const Positions& points)
      : skin_(skin),
        points_(points),
        normals_(skin.normals(skin.mesh_positions())),
        of_point_(static_cast<std::size_t>(points.rows())),
        is_found_(of_point_.size(), false) {
    std::vector<QueueEntry> nearest(of_point_.size());
    parallel_for_each(nearest.size(), [&](std::size_t p) {
      const auto found = skin.grid().nearest(row3(points, p));
      nearest[p] = {false, found.distance, static_cast<std::uint32_t>(p), found.vertex};
    });
    EdgeDistances along(adjacency, skin.mesh_positions());
    for (QueueEntry& at : nearest) at.is_ambiguous = is_ambiguous(at, along);
    std::vector<QueueEntry> starts = nearest;
    std::ranges::sort(starts);
    const Adjacency neighbours = build_adjacency(topology);
    for (const QueueEntry& start : starts) {
      if (!is_found_[start.point]) find_connected_roots(start, nearest, neighbours);
    }
  }
  const std::vector<NearestSkinPoint>& of_point() const { return of_point_; }

 private:
  struct QueueEntry {
    /// Whether the root of `point` is ambiguous (see kAmbiguousMm). In the queue, points with
    /// ambiguous roots come after all other points. So the roots of adjacent points are mostly
    /// known, and the search can start at one of these.
    bool is_ambiguous;
    double distance;  ///< distance of `point` from the nearest skin vertex
    /// `point`: a point of the attachment. `vertex`: the skin vertex at which the search for the
    /// point's root starts.
    std::uint32_t point, vertex;

    auto operator<=>(const QueueEntry&) const = default;  // NOLINT(modernize-use-nullptr)
  };

  bool is_ambiguous(const QueueEntry& at, EdgeDistances& along) const {
    const double reach = at.distance + kAmbiguousMm * skin_.units_per_mm();
    along.search(std::array{at.vertex}, kFarRatio * reach);
    const Eigen::Vector3d point = row3(points_, at.point);
    return std::ranges::any_of(skin_.grid().vertices_near(point, reach), [&](std::uint32_t v) {
      return (row3(skin_.mesh_positions(), v) - point).norm() < reach &&
             std::isinf(along.distance(v));
    });
  }

  /// Finds the root of the start point and the roots of all points that edges of the attachment's
  /// mesh connect with the start point. Points near the skin come first.
  void find_connected_roots(const QueueEntry& start, const std::vector<QueueEntry>& nearest,
                            const Adjacency& neighbours) {
    std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>> open;
    open.push(start);
    while (!open.empty()) {
      const auto [is_ambiguous, distance, point, from] = open.top();
      open.pop();
      if (is_found_[point]) continue;
      is_found_[point] = true;
      of_point_[point] =
          skin_.nearest_skin(skin_.mesh_positions(), normals_, from, row3(points_, point));
      for (const std::uint32_t next : neighbours.items_of(point)) {
        if (is_found_[next]) continue;
        QueueEntry found = nearest[next];
        found.vertex = of_point_[point].vertex;
        open.push(found);
      }
    }
  }

  const FittedSkin& skin_;
  const Positions& points_;
  Positions normals_;
  std::vector<NearestSkinPoint> of_point_;
  std::vector<bool> is_found_;
};

/// Returns the anchor of each point. An anchor is the centre of a patch: the point moved towards
/// its root by the distance `off`, or the root itself if the root is nearer than `off`.
Positions anchors_of(const std::vector<NearestSkinPoint>& roots, const Positions& points,
                     double off) {
  Positions anchors(points.rows(), 3);
  for (std::size_t p = 0; p < roots.size(); ++p) {
    const Eigen::Vector3d away = row3(points, p) - roots[p].position;
    const double distance = away.norm();
    const double share = distance > off ? (distance - off) / distance : 0;
    anchors.row(static_cast<Index>(p)) = (roots[p].position + share * away).transpose();
  }
  return anchors;
}

}  // namespace

ShapeBend::ShapeBend(const FittedSkin& skin, const Adjacency& adjacency, const Topology& topology,
                     const Positions& points) {
  std::vector<std::uint32_t> all(static_cast<std::size_t>(points.rows()));
  if (all.empty()) return;
  std::iota(all.begin(), all.end(), 0U);
  const std::vector<NearestSkinPoint> roots =
      RootSearch(skin, adjacency, topology, points).of_point();
  const Positions anchors = anchors_of(roots, points, kMaxAnchorShiftMm * skin.units_per_mm());
  const PointGrid grid(anchors, all);
  EdgeDistances along(adjacency, skin.mesh_positions());
  std::vector<std::vector<BendNodes::NodeWeight>> of_point(all.size());
  std::vector<bool> covered(all.size(), false);
  for (std::uint32_t p = 0; p < all.size(); ++p) {
    if (covered[p]) continue;
    const Eigen::Vector3d middle = row3(anchors, p);
    const auto number = static_cast<std::uint32_t>(nodes_.patches.size());
    nodes_.patches.push_back(skin.patch_around(middle, kMinPatchRadiusMm * skin.units_per_mm()));
    FittedSkin::Patch& patch = nodes_.patches.back();
    const double near = kMaxSurfaceRatio * patch.radius;
    along.search(std::array{roots[p].vertex}, near);
    const double radius = BendNodes::kInfluenceRadius * BendNodes::kNodeSpacing * patch.radius;
    for (const std::uint32_t q : grid.vertices_near(middle, radius)) {
      const double distance = (row3(anchors, q) - middle).norm() / radius;
      if (distance >= 1 || along.distance(roots[q].vertex) > near) continue;
      of_point[q].push_back({number, static_cast<float>(biweight(distance))});
      if (distance * BendNodes::kInfluenceRadius < 1) covered[q] = true;
    }
    covered[p] = true;
    remove_distant_vertices(along, near, patch);
  }
  for (const auto& shares : of_point) nodes_.node_weights.add_group(shares);
}

void ShapeBend::remove_distant_vertices(const EdgeDistances& along, double limit,
                                        FittedSkin::Patch& patch) {
  FittedSkin::Patch near{{}, {}, patch.radius};
  for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
    if (along.distance(patch.vertices[i]) > limit) continue;
    near.vertices.push_back(patch.vertices[i]);
    near.weights.push_back(patch.weights[i]);
  }
  if (near.vertices.size() >= kMinPatchVertices) patch = std::move(near);
}

Displacements ShapeBend::shape_displacements(const Positions& face, const Positions& placed,
                                             const Displacements& shape) const {
  std::vector<bool> is_moved(static_cast<std::size_t>(face.rows()), false);
  for (const std::uint32_t v : shape.vertices) is_moved[v] = true;
  Positions acting = face;
  shape.add_to(acting);
  std::vector<RigidMotion> motions(nodes_.patches.size());
  std::vector<bool> affects(motions.size(), false);
  for (std::size_t n = 0; n < motions.size(); ++n) {
    const FittedSkin::Patch& patch = nodes_.patches[n];
    affects[n] = std::ranges::any_of(patch.vertices, [&](std::uint32_t v) { return is_moved[v]; });
    if (affects[n]) motions[n] = fit_rigid_motion(face, acting, patch.vertices, patch.weights);
  }
  Displacements moves;
  moves.moves.resize(placed.rows(), 3);
  for (std::uint32_t p = 0; p < nodes_.node_weights.group_count(); ++p) {
    const Eigen::Vector3d point = row3(placed, p);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    bool any = false;
    for (const BendNodes::NodeWeight& share : nodes_.node_weights.items_of(p)) {
      const double weight = static_cast<double>(share.weight);
      weights += weight;
      if (!affects[share.node]) continue;
      any = true;
      sum += weight * (motions[share.node].apply(point) - point);
    }
    if (!any) continue;
    moves.moves.row(static_cast<Index>(moves.vertices.size())) = (sum / weights).transpose();
    moves.vertices.push_back(p);
  }
  moves.moves.conservativeResize(static_cast<Index>(moves.vertices.size()), 3);
  return moves;
}

}  // namespace crowdface
