// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/shape_bend.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "crowdface/attach/bend_places.h"
#include "crowdface/core/parallel.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {
namespace {

/// How far along the skin, in a patch's reach, skin counts as near.
constexpr double kAlong = 1.5;
/// Fewer vertices than this tell no turn: then the whole patch is heard.
constexpr std::size_t kFewest = 6;

}  // namespace

ShapeBend::ShapeBend(const FittedSkin& skin, const Adjacency& adjacency, const Positions& points) {
  std::vector<std::uint32_t> all(static_cast<std::size_t>(points.rows()));
  if (all.empty()) return;
  std::iota(all.begin(), all.end(), 0U);
  const PointGrid grid(points, all);
  BendPlaces places = find_places(skin, points, grid);
  std::vector<std::uint32_t> below(all.size());
  parallel_for_each(all.size(),
                    [&](std::size_t p) { below[p] = skin.grid().nearest(row3(points, p)).vertex; });
  EdgeDistances along(adjacency, skin.mesh());
  std::vector<std::vector<Share>> of_point(all.size());
  for (std::uint32_t n = 0; n < places.patches.size(); ++n) {
    FittedSkin::Patch& patch = places.patches[n];
    along.search(std::array{below[places.points[n]]}, kAlong * patch.reach);
    FittedSkin::Patch near{{}, {}, patch.reach};
    for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
      if (along.distance(patch.vertices[i]) > kAlong * patch.reach) continue;
      near.vertices.push_back(patch.vertices[i]);
      near.weights.push_back(patch.weights[i]);
    }
    if (near.vertices.size() >= kFewest) patch = std::move(near);
    visit_hearers(points, grid, places, n, [&](std::uint32_t p, double weight) {
      const bool is_near = along.distance(below[p]) <= kAlong * patch.reach;
      if (is_near) of_point[p].push_back({n, static_cast<float>(weight)});
    });
  }
  for (const std::vector<Share>& shares : of_point) shares_.add_group(shares);
  places_ = std::move(places.patches);
}

Displacements ShapeBend::in_shape(const Positions& face, const Positions& worn,
                                  const Displacements& shape) const {
  std::vector<bool> is_moved(static_cast<std::size_t>(face.rows()), false);
  for (const std::uint32_t v : shape.vertices) is_moved[v] = true;
  Positions acting = face;
  shape.add_to(acting);
  std::vector<bool> hears(places_.size(), false);
  std::vector<RigidMotion> motions(places_.size());
  for (std::size_t n = 0; n < places_.size(); ++n) {
    const FittedSkin::Patch& patch = places_[n];
    hears[n] = std::ranges::any_of(patch.vertices, [&](std::uint32_t v) { return is_moved[v]; });
    if (hears[n]) motions[n] = fit_rigid_motion(face, acting, patch.vertices, patch.weights);
  }
  Displacements moves;
  std::vector<Eigen::Vector3d> rows;
  for (std::uint32_t p = 0; p < shares_.group_count(); ++p) {
    const Eigen::Vector3d point = row3(worn, p);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    bool any = false;
    for (const Share& share : shares_.of(p)) {
      const double weight = static_cast<double>(share.weight);
      weights += weight;
      if (!hears[share.place]) continue;
      any = true;
      sum += weight * (motions[share.place].apply(point) - point);
    }
    if (!any) continue;
    moves.vertices.push_back(p);
    rows.emplace_back(sum / weights);
  }
  moves.moves.resize(static_cast<Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    moves.moves.row(static_cast<Index>(i)) = rows[i].transpose();
  }
  return moves;
}

std::size_t ShapeBend::memory_bytes() const {
  std::size_t bytes = shares_.items.size() * sizeof(Share);
  for (const FittedSkin::Patch& place : places_) {
    bytes += sizeof(place) + place.vertices.size() * (sizeof(std::uint32_t) + sizeof(double));
  }
  return bytes;
}

}  // namespace crowdface
