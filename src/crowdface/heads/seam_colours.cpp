// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/seam_colours.h"

#include <algorithm>
#include <cmath>

#include "crowdface/cast/compared_area.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/texture/optical_density.h"

namespace crowdface {
namespace {

/// height of the band of skin above the neck's ring, measured along the skin
constexpr double kBandMm = 20;

/// The optical densities of a head's texture around each vertex, #vertices by 3: the mean of one
/// sample from each polygon at the vertex. No rows if some vertex has no textured polygon.
Positions sampled_densities(const TextureSet& textures, const HeadSet& heads,
                            const VertexFaces& around, const std::vector<std::uint32_t>& vertices) {
  constexpr float kOwn = 0.75F;  // weight of the vertex in a sample; the centroid has 1 − kOwn
  Positions densities(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    double count = 0;
    for (const std::uint32_t face : around.items_of(vertices[i])) {
      const std::uint32_t texture = textures.texture_of_polygon.empty()
                                        ? TextureSet::kNone
                                        : textures.texture_of_polygon[face];
      if (texture == TextureSet::kNone) continue;
      const auto corners = heads.topology.face(face);
      const auto uvs = heads.topology.face_uvs(face);
      Eigen::Vector2f place = Eigen::Vector2f::Zero();
      for (std::size_t c = 0; c < corners.size(); ++c) {
        const float share = (1 - kOwn) / static_cast<float>(corners.size()) +
                            (corners[c] == vertices[i] ? kOwn : 0.0F);
        place += share * heads.uvs.row(uvs[c]).transpose().cast<float>();
      }
      const LinearRgb light = colour_at(*textures.textures[texture], place);
      for (int c = 0; c < 3; ++c) sum[c] += density_of_light(light[c]);
      count += 1;
    }
    if (count == 0) return Positions(0, 3);
    densities.row(static_cast<Index>(i)) = (sum / count).matrix().transpose();
  }
  return densities;
}

/// Returns the optical densities of a head's texture at some vertices, without fine detail (the low
/// frequencies only): #vertices by 3.
Positions coarse_densities(const TextureBlender& blender, std::size_t head,
                           const std::vector<std::uint32_t>& vertices) {
  Positions densities(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    densities.row(static_cast<Index>(i)) =
        blender.statistics().coarse_values[head].row(vertices[i]).cast<double>();
  }
  return densities;
}

Positions densities_at(const ColourRows& colours, const std::vector<std::uint32_t>& vertices) {
  if (colours.rows() == 0) return Positions(0, 3);
  Positions densities(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (Index c = 0; c < 3; ++c) {
      densities(static_cast<Index>(i), c) = density_by_srgb8()[colours(vertices[i], c)];
    }
  }
  return densities;
}

/// Index of the image, in the layout of blended textures, that the polygons at the neck's rim use;
/// kNoIndex if these polygons have no image.
std::uint32_t picture_at(const Rim& rim, const VertexFaces& around, const TextureLayout& layout) {
  for (const std::uint32_t face : around.items_of(rim.front())) {
    if (layout.picture_of_polygon[face] != kNoIndex) return layout.picture_of_polygon[face];
  }
  return kNoIndex;
}

}  // namespace

SeamColours::SeamColours(const Inputs& inputs, const TextureBlender* blended) {
  const HeadSet& heads = inputs.head_set;
  const Rim& rim = inputs.heads_on_body->seam.rim;
  vertices_ = rim;
  ring_size_ = static_cast<Index>(rim.size());
  EdgeDistances distances(inputs.adjacency, inputs.mean_head);
  distances.search(rim, kBandMm / inputs.heads_on_body->mm_per_unit);
  for (const std::uint32_t v : distances.reached()) {
    if (distances.distance(v) > 0) vertices_.push_back(v);
  }
  const std::vector<double> areas = compared_vertex_areas(
      heads.topology, inputs.skin_components, inputs.mean_head, ComparedArea::kSkin, {2, 1});
  double total = 0;
  for (const std::uint32_t v : vertices_) total += areas[v];
  for (const std::uint32_t v : vertices_) areas_.push_back(areas[v] / total);
  head_optical_densities_.assign(heads.heads.size(), Positions(0, 3));
  const VertexFaces around(heads.topology);
  const std::uint32_t picture =
      blended == nullptr ? kNoIndex : picture_at(rim, around, inputs.textures.blended.layout);
  for (std::size_t h = 0; h < head_optical_densities_.size(); ++h) {
    if (picture != kNoIndex) {
      if (inputs.textures.blended.maps[picture][h])
        head_optical_densities_[h] = coarse_densities(*blended, h, vertices_);
    } else if (!inputs.textures.texture_sets.empty()) {
      head_optical_densities_[h] =
          sampled_densities(inputs.textures.texture_sets[h], heads, around, vertices_);
    } else if (!inputs.vertex_colours.empty()) {
      head_optical_densities_[h] = densities_at(inputs.vertex_colours[h], vertices_);
    }
  }
}

bool SeamColours::has_colours() const {
  return std::ranges::any_of(head_optical_densities_,
                             [](const Positions& rows) { return rows.rows() > 0; });
}

OpticalDensities SeamColours::blend(const std::vector<double>& weights, Index rows) const {
  double sum = 0;
  for (std::size_t h = 0; h < head_optical_densities_.size(); ++h) {
    if (head_optical_densities_[h].rows() > 0) sum += weights[h];
  }
  Positions blended = Positions::Zero(rows, 3);
  double total = 0;
  for (std::size_t h = 0; h < head_optical_densities_.size(); ++h) {
    const double weight = sum > 0 ? weights[h] : 1;
    if (head_optical_densities_[h].rows() == 0 || weight == 0) continue;
    blended += weight * head_optical_densities_[h].topRows(rows);
    total += weight;
  }
  return blended / total;
}

OpticalDensities SeamColours::optical_densities_at_ring(const std::vector<double>& weights) const {
  return blend(weights, ring_size_);
}

Eigen::Array3d SeamColours::mean_colour(const std::vector<double>& weights) const {
  const Positions densities = blend(weights, static_cast<Index>(vertices_.size()));
  Eigen::Array3d light = Eigen::Array3d::Zero();
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      light[c] += areas_[i] * static_cast<double>(light_of_density(
                                  static_cast<float>(densities(static_cast<Index>(i), c))));
    }
  }
  return light;
}

}  // namespace crowdface
