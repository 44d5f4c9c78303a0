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
  place.is_covered = true;
  if (lattice_point.patch == SkinPatch::kEye) place.eye_ring_coordinate = lattice_point.b;
  if (lattice_point.patch == SkinPatch::kMouth) place.mouth_ring_coordinate = lattice_point.b;
  if (lattice_point.patch == SkinPatch::kNostril) place.nostril_ring_coordinate = lattice_point.b;
  return place;
}

AtlasTexel mix_places(const std::array<const AtlasTexel*, 3>& corners,
                      const std::array<double, 3>& weights) {
  AtlasTexel place;
  place.is_covered = true;
  place.skin = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0};
  for (std::size_t c = 0; c < 3; ++c) {
    place.skin.position += weights[c] * corners[c]->skin.position;
    place.skin.normal += weights[c] * corners[c]->skin.normal;
    place.skin.relief_weight += weights[c] * corners[c]->skin.relief_weight;
    place.eye_ring_coordinate += weights[c] * corners[c]->eye_ring_coordinate;
    place.mouth_ring_coordinate += weights[c] * corners[c]->mouth_ring_coordinate;
    place.nostril_ring_coordinate += weights[c] * corners[c]->nostril_ring_coordinate;
    place.on_eyeball += weights[c] * corners[c]->on_eyeball;
    place.point_on_ball += weights[c] * corners[c]->point_on_ball;
  }
  place.skin.normal.normalize();
  return place;
}

/// Rasterises a triangle of the texture: fills the texels whose centres lie inside.
/// \param at  corners in texels.
void draw(const std::array<Vector2d, 3>& at, const std::array<const AtlasTexel*, 3>& corners,
          int size, std::vector<AtlasTexel>& texels) {
  const auto cross = [](const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const double area = cross(at[1] - at[0], at[2] - at[0]);
  if (area == 0) return;
  const Vector2d low = at[0].cwiseMin(at[1]).cwiseMin(at[2]);
  const Vector2d high = at[0].cwiseMax(at[1]).cwiseMax(at[2]);
  const auto texel = [size](double x) { return std::clamp(static_cast<int>(x), 0, size - 1); };
  for (int y = texel(low.y()); y <= texel(high.y()); ++y) {
    for (int x = texel(low.x()); x <= texel(high.x()); ++x) {
      const Vector2d centre(x + 0.5, y + 0.5);
      const double b = cross(centre - at[0], at[2] - at[0]) / area;
      const double c = cross(at[1] - at[0], centre - at[0]) / area;
      if (b < 0 || c < 0 || b + c > 1) continue;
      texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
             static_cast<std::size_t>(x)] = mix_places(corners, {1 - b - c, b, c});
    }
  }
}

/// Fills uncovered texels from their neighbours by a breadth-first search from the covered texels.
void spread(int size, std::vector<AtlasTexel>& texels) {
  std::vector<std::size_t> reached;
  std::vector<bool> taken(texels.size());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    taken[i] = texels[i].is_covered;
    if (!taken[i]) continue;
    texels[i].source_texel = i;
    reached.push_back(i);
  }
  const auto width = static_cast<std::size_t>(size);
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::size_t i = reached[next], x = i % width, y = i / width;
    const auto take = [&](std::size_t other) {
      if (taken[other]) return;
      taken[other] = true;
      texels[other] = texels[i];
      texels[other].is_covered = false;
      reached.push_back(other);
    };
    if (x > 0) take(i - 1);
    if (x + 1 < width) take(i + 1);
    if (y > 0) take(i - width);
    if (y + 1 < width) take(i + width);
  }
}

}  // namespace

std::vector<AtlasTexel> skin_atlas(int size) {
  Layout layout = make_layout(kVertices);
  const LooseParts loose(0.5 * std::sqrt(5000.0 / kVertices));
  std::vector<AtlasTexel> places(layout.lattice_points.size());
  parallel_for_each(places.size(), 1024,
                    [&](std::size_t i) { places[i] = place_at(layout.lattice_points[i]); });
  // Append eyeballs and teeth. The texture shows only the fronts of the eyeballs.
  loose.append_to(layout.topology, layout.uvs);
  for (Index v = 0; v < loose.vertex_count(); ++v) {
    AtlasTexel place;
    place.skin = {eye_centre(), Eigen::Vector3d::UnitZ(), 0};
    place.is_covered = loose.is_on_eyeball(v) && loose.point_on_eyeball(v).z() > -0.1;
    place.on_eyeball = place.is_covered ? 1 : 0;
    if (place.is_covered) place.point_on_ball = loose.point_on_eyeball(v);
    places.push_back(place);
  }
  // Rasterise all polygons into the texture, then fill the texels outside the charts.
  std::vector<AtlasTexel> texels(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  const Topology& topology = layout.topology;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::uint32_t first = topology.face_offsets[static_cast<std::size_t>(f)];
    const auto at = [&](std::uint32_t corner) {
      const auto uv = layout.uvs.row(topology.corner_uvs[corner]);
      return Vector2d(uv.x() * size, (1 - uv.y()) * size);
    };
    const auto place = [&](std::uint32_t corner) {
      return &places[topology.corner_vertices[corner]];
    };
    const auto corners = static_cast<std::uint32_t>(topology.face(f).size());
    // Skip teeth, which have no texture, and the backs of eyeballs, which would overlap the fronts
    // in the texture.
    bool shown = true;
    for (std::uint32_t c = 0; c < corners; ++c) shown = shown && place(first + c)->is_covered;
    if (!shown) continue;
    for (std::uint32_t c = 1; c + 1 < corners; ++c) {
      draw({at(first), at(first + c), at(first + c + 1)},
           {place(first), place(first + c), place(first + c + 1)}, size, texels);
    }
  }
  spread(size, texels);
  return texels;
}

}  // namespace crowdface::synth
