// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/contact.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/quadratic_program.h"

namespace crowdface {
namespace {

/// Largest number of a part's vertices that are tested for contact with the skin; a part with more
/// vertices is subsampled evenly.
constexpr std::size_t kMaxVertices = 2500;
/// Largest number of pairs in a cluster.
constexpr std::size_t kClusterPairs = 16;
/// Safety factor of Cluster::height_margin: on a new face, the height differences within a cluster
/// may be larger than on any head.
constexpr double kHeightMarginFactor = 1.5;
/// Heights (signed distances from the skin), as fractions of the reach (about 4 mm).
/// kMaxNearHeight: the exact height is measured only for vertices whose approximate height is less
/// than kMaxNearHeight. kMinOutsideHeight: vertices above this height count as outside the skin.
constexpr double kMaxNearHeight = 0.5, kMinOutsideHeight = -0.005;
/// Fractions of the reach. kMaxLaterHeight: if a step finds a vertex above this height, this step
/// and all later steps ignore the vertex. kMaxViolation: the iteration ends when every height is at
/// least its lower bound minus kMaxViolation.
constexpr double kMaxLaterHeight = 0.15, kMaxViolation = 0.002;
/// Costs of a rotation (kRotationCost) and of a change of size (kSizeCost), relative to a
/// translation that moves the vertices by the same distance.
constexpr double kRotationCost = 1, kSizeCost = 2;
/// Largest decrease (kMaxShrink) and increase (kMaxGrowth) of a part's size, as fractions of the
/// size.
constexpr double kMaxShrink = 0.06, kMaxGrowth = 0.01;
/// Penalties for violated constraints, as multiples of the reach of PartContact (violations are
/// lengths, and a penalty is a cost per violation). kOutsidePenalty: for vertices that are outside
/// the skin in all heads; these vertices have priority. kInsidePenalty: for all other vertices.
constexpr double kOutsidePenalty = 1000, kInsidePenalty = 1;
/// The constraints of a step are exact only near the part's position. If a step would translate the
/// part by more than kMaxStep (a fraction of the reach), or if no position meets the constraints of
/// vertices that stay outside the skin, the best step may change by centimetres with a tiny change
/// of the skin. The step is then computed again with kCautiousPenalty instead of kOutsidePenalty,
/// and with translations and rotations of at most kMaxCautiousStep along and about each axis.
constexpr double kMaxStep = 0.5, kMaxCautiousStep = 0.1, kCautiousPenalty = 10;

/// Index of the first unknown of each kind in an optimisation step of a part: translation (3
/// unknowns), rotation (3), change of size, and two slack variables. The slack variables are the
/// violations of constraints that kOutsidePenalty and kInsidePenalty penalise. All unknowns are
/// lengths: rotation and change of size are multiplied by the part's radius.
enum Unknown : std::size_t {
  kShift = 0,
  kTurn = 3,
  kSize = 6,
  kOutsideSlack,
  kInsideSlack,
  kUnknowns
};

}  // namespace

PartContact::PartContact(const Topology& topology, const VertexFaces& faces,
                         const Positions& positions, const PointGrid& grid,
                         std::span<const std::uint32_t> skin, std::span<const std::uint32_t> part,
                         double reach, const std::vector<Head>& heads)
    : topology_(&topology), faces_(&faces), reach_(reach), middle_(centre_of(positions, part)) {
  radius_ = std::max(radius_about(middle_, positions, part), 1e-3 * reach);
  double sum = 0;
  for (const std::uint32_t v : evenly_spaced_items(part, kMaxVertices)) {
    const Eigen::Vector3d point = positions.row(v).transpose();
    const auto nearest = grid.nearest(point, 2 * reach);
    if (nearest.vertex == kNoIndex) continue;
    const SurfacePoint place =
        nearest_point_around(topology, faces, positions, nearest.vertex, point);
    if (place.distance > reach) continue;
    const std::uint32_t start = place.corners[0];
    pairs_.push_back({v, place.corners, place.barycentric, {start, start, start}, 1e300});
    sum += height(pairs_.size() - 1, point, positions).height > 0 ? 1 : -1;
  }
  // The majority determines the sign of the normals: most vertices of a part are outside the skin,
  // although roots of teeth may be inside.
  normal_sign_ = sum < 0 ? -1 : 1;
  find_search_starts(positions, skin, heads);
  find_clusters(positions, heads);
  parallel_for_each(pairs_.size(), 64, [&](std::size_t i) {
    for (const Head& head : heads) {
      const Eigen::Vector3d point = row3(head.positions, pairs_[i].vertex);
      pairs_[i].min_height =
          std::min(pairs_[i].min_height, height(i, point, head.positions).height);
    }
  });
}

void PartContact::find_search_starts(const Positions& positions,
                                     std::span<const std::uint32_t> skin,
                                     const std::vector<Head>& heads) {
  // If two start vertices are nearer to each other than this distance, searches from both find the
  // same point of the skin.
  const double apart = 0.3 * reach_;
  // In every head, find the skin vertex that is nearest to the part's vertex of each pair.
  std::vector<std::vector<std::uint32_t>> nearest(heads.size());
  parallel_for_each(heads.size(), [&](std::size_t i) {
    const Positions& head = heads[i].positions;
    Eigen::AlignedBox3d box;
    for (const Pair& pair : pairs_) box.extend(row3(head, pair.vertex));
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(2 * reach_);
    box = {box.min() - reach, box.max() + reach};
    std::vector<std::uint32_t> about;
    for (const std::uint32_t v : skin) {
      if (box.contains(row3(head, v))) about.push_back(v);
    }
    nearest[i].assign(pairs_.size(), kNoIndex);
    if (about.empty()) return;
    const PointGrid grid(head, about);
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      nearest[i][p] = grid.nearest(row3(head, pairs_[p].vertex), 2 * reach_).vertex;
    }
  });
  // `nearest` has, for each head and pair, the nearest skin vertex. Choose at most kMaxSearchStarts
  // of a pair's nearest vertices as start vertices. Omit a vertex that is closer than `apart` to
  // another start vertex of the pair.
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    SearchStarts& starts = pairs_[i].search_starts;
    std::size_t count = 1;
    for (const auto& of_head : nearest) {
      const std::uint32_t v = of_head[i];
      const auto is_near = [&](std::uint32_t start) {
        return (row3(positions, v) - row3(positions, start)).norm() < apart;
      };
      if (v == kNoIndex || count == kMaxSearchStarts ||
          std::any_of(starts.begin(), starts.begin() + count, is_near)) {
        continue;
      }
      starts[count++] = v;
    }
  }
}

void PartContact::find_clusters(const Positions& positions, const std::vector<Head>& heads) {
  // Split the pairs at the median of the longest axis until each cluster is small.
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, pairs_.size()}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    if (end - begin <= kClusterPairs) {
      if (begin < end) clusters_.push_back({begin, end, 0});
      continue;
    }
    Eigen::AlignedBox3d box;
    for (std::size_t i = begin; i < end; ++i) box.extend(row3(positions, pairs_[i].vertex));
    Index axis = 0;
    box.sizes().maxCoeff(&axis);
    std::sort(pairs_.begin() + static_cast<std::ptrdiff_t>(begin),
              pairs_.begin() + static_cast<std::ptrdiff_t>(end), [&](const Pair& a, const Pair& b) {
                const double at = positions(a.vertex, axis), bt = positions(b.vertex, axis);
                return at != bt ? at < bt : a.vertex < b.vertex;
              });
    const std::size_t middle = begin + (end - begin) / 2;
    open.emplace_back(middle, end);
    open.emplace_back(begin, middle);
  }
  // Set Cluster::height_margin of each cluster. In every head, measure by how much the cluster's
  // middle pair is higher above the skin than each other pair of the cluster; use the maximum.
  for (Cluster& cluster : clusters_) {
    for (const Head& head : heads) {
      const auto rough = [&](std::size_t i) {
        const Eigen::Vector3d point = head.positions.row(pairs_[i].vertex).transpose();
        return approximate_height(pairs_[i], point, head.positions);
      };
      const double here = rough(cluster.middle());
      for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
        cluster.height_margin =
            std::max(cluster.height_margin, kHeightMarginFactor * (here - rough(i)));
      }
    }
  }
}

double PartContact::approximate_height(const Pair& pair, const Eigen::Vector3d& point,
                                       const Positions& skin) const {
  const Eigen::Vector3d place = point_on(skin, pair.corners, pair.barycentric);
  return normal_sign_ * area_vector(skin, pair.corners).normalized().dot(point - place);
}

Eigen::Vector3d PartContact::normal_near(const SurfacePoint& place, const Positions& skin) const {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (place.barycentric[k] <= 0) continue;
    Eigen::Vector3d at_corner = Eigen::Vector3d::Zero();
    for (const std::uint32_t f : faces_->items_of(place.corners[k])) {
      const auto face = topology_->face(f);
      const Eigen::Vector3d first = skin.row(face[0]).transpose();
      for (std::size_t j = 1; j + 1 < face.size(); ++j) {
        at_corner += (row3(skin, face[j]) - first).cross(row3(skin, face[j + 1]) - first);
      }
    }
    normal += place.barycentric[k] * at_corner.normalized();
  }
  return normal_sign_ * normal.normalized();
}

PartContact::Height PartContact::height(std::size_t pair, const Eigen::Vector3d& point,
                                        const Positions& skin) const {
  const SearchStarts& starts = pairs_[pair].search_starts;
  SearchStarts ends = {};
  SurfacePoint place;
  for (std::size_t s = 0; s < kMaxSearchStarts && (s == 0 || starts[s] != starts[0]); ++s) {
    ends[s] = walk_to_nearest_vertex(*topology_, *faces_, skin, starts[s], point);
    if (std::find(ends.begin(), ends.begin() + s, ends[s]) != ends.begin() + s) continue;
    const SurfacePoint other = nearest_point_from(*topology_, *faces_, skin, ends[s], point);
    if (s == 0 || other.distance < place.distance) place = other;
  }
  const Eigen::Vector3d normal = normal_near(place, skin);
  const Eigen::Vector3d from = point - place.position;
  const double side = from.dot(normal) < 0 ? -1 : 1;
  if (place.distance < 1e-3 * reach_) return {side * place.distance, normal};
  return {side * place.distance, side / place.distance * from};
}

RigidMotion PartContact::keep_out_of_skin(const Positions& target, const RigidMotion& motion,
                                          const Positions& moved_face, double margin) const {
  constexpr int kSteps = 4;
  RigidMotion cleared = motion;
  const auto rough = [&](const Pair& pair) {
    const Eigen::Vector3d point = motion.apply(target.row(pair.vertex).transpose());
    return approximate_height(pair, point, moved_face);
  };
  std::vector<std::uint32_t> near;
  for (const Cluster& cluster : clusters_) {
    if (rough(pairs_[cluster.middle()]) - cluster.height_margin >= kMaxNearHeight * reach_)
      continue;
    for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
      if (rough(pairs_[i]) >= kMaxNearHeight * reach_) continue;
      near.push_back(static_cast<std::uint32_t>(i));
    }
  }
  for (int k = 0; k < kSteps; ++k) {
    if (!step(target, motion, moved_face, margin, near, cleared)) break;
  }
  return cleared;
}

bool PartContact::step(const Positions& target, const RigidMotion& start,
                       const Positions& moved_face, double margin, std::vector<std::uint32_t>& near,
                       RigidMotion& motion) const {
  const Eigen::Vector3d middle = motion.apply(middle_);
  const Eigen::Vector3d shifted = middle - start.apply(middle_);
  const double radius = motion.scale * radius_;
  const double grown = (motion.scale / start.scale - 1) * radius;
  QuadraticProgram program(kUnknowns);
  bool missing = false;
  std::size_t kept = 0;
  // Each pair near the skin gives a constraint.
  for (const std::uint32_t i : near) {
    const Pair& pair = pairs_[i];
    const Eigen::Vector3d point = motion.apply(target.row(pair.vertex).transpose());
    const Height now = height(i, point, moved_face);
    if (now.height > kMaxLaterHeight * reach_) continue;
    near[kept++] = i;
    const Eigen::Vector3d from = point - middle;
    const Eigen::Vector3d arm = from.cross(now.outward) / radius;
    const bool never = pair.min_height > kMinOutsideHeight * reach_;
    const double least =
        never ? std::clamp(pair.min_height, 0.2 * margin, margin) : pair.min_height;
    missing = missing || now.height < least - kMaxViolation * reach_;
    QuadraticProgram::Vector a = {now.outward.x(),
                                  now.outward.y(),
                                  now.outward.z(),
                                  arm.x(),
                                  arm.y(),
                                  arm.z(),
                                  from.dot(now.outward) / radius};
    a[never ? kOutsideSlack : kInsideSlack] = 1;
    program.add_lower_bound(a, least - now.height);
  }
  near.resize(kept);
  if (!missing) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    program.add_target(kShift + i, -shifted(static_cast<Index>(i)), 1);
    program.add_target(kTurn + i, 0, kRotationCost);
  }
  // Keep the total change of the part's size small, and within fixed limits.
  program.add_target(kSize, -grown, kSizeCost);
  program.add_bounds(kSize, -kMaxShrink * radius - grown, kMaxGrowth * radius - grown);
  const auto solve = [&](double outside_penalty) {
    QuadraticProgram penalised = program;
    penalised.add_slack(kOutsideSlack, outside_penalty * reach_);
    penalised.add_slack(kInsideSlack, kInsidePenalty * reach_);
    return penalised.solve(1e-5 * reach_);
  };
  QuadraticProgram::Vector x = solve(kOutsidePenalty);
  const double translation = Eigen::Vector3d(x[kShift], x[kShift + 1], x[kShift + 2]).norm();
  if (x[kOutsideSlack] > kMaxViolation * reach_ || translation > kMaxStep * reach_) {
    const double most = kMaxCautiousStep * reach_;
    for (std::size_t i = 0; i < 3; ++i) {
      program.add_bounds(kShift + i, -most, most);
      program.add_bounds(kTurn + i, -most, most);
    }
    x = solve(kCautiousPenalty);
  }
  motion =
      nudged(motion, middle, {x[0], x[1], x[2]},
             Eigen::Vector3d(x[kTurn], x[kTurn + 1], x[kTurn + 2]) / radius, x[kSize] / radius);
  return true;
}

}  // namespace crowdface
