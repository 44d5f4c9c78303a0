// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/skin_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "head_models/synth/layout.h"
#include "head_models/synth/loose_parts.h"
#include "head_models/synth/sculpture.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector2d;

/// Number of vertices of the layout. The layout is so fine that its edges are not visible in a
/// texture.
constexpr Index kVertices = 60'000;

AtlasTexel place_at(const LatticePoint& lattice_point) {
  AtlasTexel place;
  place.skin = mean_skin_with_sockets(lattice_point);
  if (lattice_point.patch == SkinPatch::kEye) place.eye_ring_coordinate = lattice_point.b;
  if (lattice_point.patch == SkinPatch::kMouth) place.mouth_ring_coordinate = lattice_point.b;
  if (lattice_point.patch == SkinPatch::kNostril) place.nostril_ring_coordinate = lattice_point.b;
  return place;
}

double cross_z(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

SkinAtlas::SkinAtlas(int side)
    : side_(static_cast<std::size_t>(side)), texels_(side_ * side_, kFirstCopy) {
  Layout layout = make_layout(kVertices);
  const LooseParts loose(0.5 * std::sqrt(5000.0 / kVertices));
  points_.resize(layout.lattice_points.size());
  parallel_for_each(points_.size(), 1024,
                    [&](std::size_t i) { points_[i] = place_at(layout.lattice_points[i]); });
  // Append eyeballs and teeth. The texture shows only the fronts of the eyeballs: teeth have no
  // texture, and the backs of eyeballs would overlap the fronts.
  std::vector<bool> is_shown(points_.size(), true);
  loose.append_to(layout.topology, layout.uvs);
  for (Index v = 0; v < loose.vertex_count(); ++v) {
    is_shown.push_back(loose.is_on_eyeball(v) && loose.point_on_eyeball(v).z() > -0.1);
    AtlasTexel point;
    point.skin = {eye_centre(), Eigen::Vector3d::UnitZ(), 0};
    point.on_eyeball = 1;
    if (is_shown.back()) point.point_on_ball = loose.point_on_eyeball(v);
    points_.push_back(point);
  }
  const Topology& topology = layout.topology;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::uint32_t first = topology.face_offsets[static_cast<std::size_t>(f)];
    const auto points = topology.face(f);
    if (!std::ranges::all_of(points, [&](std::uint32_t point) { return is_shown[point]; }))
      continue;
    const auto corner = [&](std::size_t c) {
      const auto uv = layout.uvs.row(topology.corner_uvs[first + c]);
      return Vector2d(uv.x() * side, (1 - uv.y()) * side);
    };
    for (std::size_t c = 1; c + 1 < points.size(); ++c) {
      triangles_.push_back(
          {{corner(0), corner(c), corner(c + 1)}, {points[0], points[c], points[c + 1]}});
    }
  }
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) rasterise(t);
  find_sources_of_uncovered_texels();
}

Eigen::Vector3d SkinAtlas::barycentric(const Triangle& triangle, std::size_t texel) const {
  const auto& [p, q, r] = triangle.corners;
  const std::size_t row = texel / side_, column = texel % side_;
  const Vector2d centre(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
  const double area = cross_z(q - p, r - p);
  const double b = cross_z(centre - p, r - p) / area;
  const double c = cross_z(q - p, centre - p) / area;
  return {1 - b - c, b, c};
}

/// Assigns the triangle to the texels whose centres lie in it.
void SkinAtlas::rasterise(std::uint32_t triangle) {
  const auto& [p, q, r] = triangles_[triangle].corners;
  if (cross_z(q - p, r - p) == 0) return;
  const auto texel = [this](double x) {
    return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(side_ - 1)));
  };
  const Vector2d low = p.cwiseMin(q).cwiseMin(r), high = p.cwiseMax(q).cwiseMax(r);
  for (std::size_t y = texel(low.y()); y <= texel(high.y()); ++y) {
    for (std::size_t x = texel(low.x()); x <= texel(high.x()); ++x) {
      const std::size_t at = y * side_ + x;
      const Eigen::Vector3d weights = barycentric(triangles_[triangle], at);
      if (weights[1] >= 0 && weights[2] >= 0 && weights[1] + weights[2] <= 1) {
        texels_[at] = triangle;
      }
    }
  }
}

/// Finds the source_texel of each uncovered texel, by a breadth-first search from the covered
/// texels.
void SkinAtlas::find_sources_of_uncovered_texels() {
  std::vector<std::uint32_t> reached;
  std::vector<bool> is_reached(size());
  const auto reach = [&](std::size_t texel, std::size_t source) {
    if (is_reached[texel]) return;
    is_reached[texel] = true;
    reached.push_back(static_cast<std::uint32_t>(texel));
    if (texel != source) texels_[texel] = kFirstCopy + static_cast<std::uint32_t>(source);
  };
  for (std::size_t i = 0; i < size(); ++i) {
    if (is_covered(i)) reach(i, i);
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::size_t i = reached[next], x = i % side_, y = i / side_;
    const std::size_t source = source_texel(i);
    if (x > 0) reach(i - 1, source);
    if (x + 1 < side_) reach(i + 1, source);
    if (y > 0) reach(i - side_, source);
    if (y + 1 < side_) reach(i + side_, source);
  }
}

AtlasTexel SkinAtlas::operator[](std::size_t texel) const {
  const std::size_t source = source_texel(texel);
  const Triangle& triangle = triangles_[texels_[source]];
  const Eigen::Vector3d weights = barycentric(triangle, source);
  AtlasTexel place;
  place.skin = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0};
  for (std::size_t c = 0; c < 3; ++c) {
    const AtlasTexel& corner = points_[triangle.points[c]];
    const double weight = weights[static_cast<Index>(c)];
    place.skin.position += weight * corner.skin.position;
    place.skin.normal += weight * corner.skin.normal;
    place.skin.relief_weight += weight * corner.skin.relief_weight;
    place.eye_ring_coordinate += weight * corner.eye_ring_coordinate;
    place.mouth_ring_coordinate += weight * corner.mouth_ring_coordinate;
    place.nostril_ring_coordinate += weight * corner.nostril_ring_coordinate;
    place.on_eyeball += weight * corner.on_eyeball;
    place.point_on_ball += weight * corner.point_on_ball;
  }
  place.skin.normal.normalize();
  return place;
}

}  // namespace crowdface::synth
