// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/face_textures.h"

#include <algorithm>
#include <set>
#include <utility>

#include "crowdface/cast/compared_area.h"
#include "crowdface/heads/cached_statistics.h"
#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/smooth/level_size.h"
#include "crowdface/smooth/smoothing_operator.h"
#include "crowdface/texture/vertex_colours_blend.h"

namespace crowdface {
namespace {

/// Colour variation with a wavelength above this limit is blended as a weighted mean. Variation
/// below the limit keeps its contrast: brows, lip borders, freckles, stubble, pores.
constexpr double kDetailMm = 24;
/// Distance on the skin over which the strength (contrast) of detail is averaged.
constexpr double kStrengthMm = 48;

}  // namespace

Recipe recipe_of_head(Index head) {
  Recipe recipe;
  recipe.target = head;
  recipe.colours = {{head, 1}};
  return recipe;
}

std::vector<PictureName> face_picture_names(const Inputs& inputs) {
  std::vector<PictureName> pictures = inputs.textures.names;
  for (const HeadTextures& maps : inputs.other_textures) {
    pictures.insert(pictures.end(), maps.names.begin(), maps.names.end());
  }
  return pictures;
}

FaceTextures::FaceTextures(const Config& config, const Inputs& inputs)
    : inputs_(inputs), are_blended_(config.textures.blend == TextureBlend::kAuto) {
  make_blenders(config);
  if (!inputs.heads_on_body) return;
  SeamColours seam(inputs, inputs.textures.are_blended() ? blenders_.front().get() : nullptr);
  if (!seam.has_colours()) return;
  seam_.emplace(std::move(seam));
  if (!config.neck.show_body && config.neck.body_texture.empty()) return;
  body_ = std::make_unique<const BodyPainter>(*inputs.heads_on_body, config.neck.falloff_mm,
                                              config.neck.body_texture);
}

void FaceTextures::make_blenders(const Config& config) {
  const Inputs& inputs = inputs_;
  if (!blends_textures(inputs) && inputs.vertex_colours.empty()) return;
  const Topology& topology = inputs.head_set.topology;
  TextureBlendOptions options;
  const auto iterations = [&](double size_mm) {
    return std::max<std::uint64_t>(
        1, iterations_for_wavelength(OperatorKind::kLazy, size_mm, inputs.edge_length_mm));
  };
  options.statistics_scale = {iterations(kDetailMm), iterations(kStrengthMm)};
  options.vertex_areas =
      compared_vertex_areas(topology, inputs.skin_components, mean_head(inputs.head_set),
                            ComparedArea::kFront, config.faces.front);
  options.uses_target_colours_only.assign(static_cast<std::size_t>(topology.vertex_count), false);
  for (const Part& part : inputs.parts.parts) {
    for (const std::uint32_t vertex : part.vertices)
      options.uses_target_colours_only[vertex] = true;
  }
  region_area_fractions_ = region_area_fractions(inputs.regions, options.vertex_areas);
  if (!inputs.vertex_colours.empty()) uses_target_colours_only_ = options.uses_target_colours_only;
  if (!blends_textures(inputs)) return;
  const ChebyshevFilter filter(
      SmoothingOperator(inputs.adjacency, Boundary::kFree, OperatorKind::kLazy),
      inputs.head_set.heads.front().positions);
  const Digest rows =
      Hasher().add(inputs.topology_digest).add(inputs.head_digests.front()).digest();
  const auto texels_of = [&](const TextureLayout& layout) {
    for (const auto& blender : blenders_) {
      if (blender->layout() == layout) return blender->texels();
    }
    return rasterize_layout(topology, inputs.head_set.uvs, layout);
  };
  const auto add = [&](const HeadTextures& textures) {
    const auto find = [&](const std::function<SurfaceStatistics()>& make) {
      if (inputs.cache.empty()) return make();
      return cached_statistics(inputs.cache,
                               statistics_key(rows, topology, inputs.head_set.uvs, textures.blended,
                                              options.statistics_scale),
                               static_cast<std::size_t>(topology.vertex_count),
                               inputs.head_set.heads.size(), make);
    };
    blenders_.push_back(
        std::make_unique<TextureBlender>(topology, texels_of(textures.blended.layout), filter,
                                         inputs.regions, textures.blended, options, find));
    for (std::size_t p = 0; p < textures.names.size(); ++p) {
      pictures_.push_back({blenders_.back().get(), p});
    }
  };
  if (inputs.textures.are_blended()) add(inputs.textures);
  for (const HeadTextures& maps : inputs.other_textures) add(maps);
}

BlendedPicture FaceTextures::blend(const Recipe& recipe, std::size_t picture) const {
  return pictures_[picture].blender->blend(recipe, pictures_[picture].index);
}

ColourRows FaceTextures::vertex_colours(const Recipe& recipe) const {
  if (inputs_.vertex_colours.empty()) return ColourRows(0, 3);
  FaceColourWeights weights =
      face_colour_weights(recipe, inputs_.vertex_colours.size(), region_area_fractions_);
  if (!are_blended_) weights.weights_for_skin = weights.weights_for_eyes_and_teeth;
  return blend_vertex_colours(inputs_.vertex_colours, weights, uses_target_colours_only_);
}

std::vector<double> FaceTextures::head_weights_in_mean_colour(const Recipe& recipe) const {
  const std::size_t heads = inputs_.head_set.heads.size();
  if (inputs_.textures.are_blended() || (are_blended_ && inputs_.textures.texture_sets.empty())) {
    return face_colour_weights(recipe, heads, region_area_fractions_).weights_for_skin;
  }
  std::vector<double> shares(heads, 0.0);
  shares[static_cast<std::size_t>(recipe.target)] = 1;
  return shares;
}

BlendedPicture FaceTextures::paint_body(const Recipe& recipe) const {
  return body_->paint(seam_->optical_densities_at_ring(head_weights_in_mean_colour(recipe)));
}

std::optional<Eigen::Array3d> FaceTextures::seam_colour(const Recipe& recipe) const {
  if (!seam_) return std::nullopt;
  return seam_->mean_colour(head_weights_in_mean_colour(recipe));
}

std::uint64_t FaceTextures::memory_bytes() const {
  std::uint64_t bytes = 0;
  std::set<const LayoutTexels*> layouts;  // blenders share texels
  for (const auto& blender : blenders_) {
    bytes += blender->memory_bytes();
    if (!layouts.insert(blender->texels().get()).second) continue;
    for (const SurfaceTexels& texels : *blender->texels()) bytes += texels.memory_bytes();
  }
  return bytes;
}

std::uint64_t FaceTextures::blend_bytes() const {
  std::uint64_t most = 0;
  for (const auto& blender : blenders_) most = std::max(most, blender->blend_bytes());
  return most;
}

std::uint64_t texture_bytes(const Inputs& inputs) {
  std::set<const TextureMap*> maps;  // a set, because heads may share maps
  const auto add = [&](const HeadTextures& textures) {
    for (const auto& of_picture : textures.blended.maps) {
      for (const auto& map : of_picture) maps.insert(map.get());
    }
  };
  add(inputs.textures);
  for (const HeadTextures& textures : inputs.other_textures) add(textures);
  std::uint64_t bytes = 0;
  for (const ColourRows& colours : inputs.vertex_colours) {
    bytes += static_cast<std::uint64_t>(colours.size());
  }
  for (const TextureMap* map : maps) {
    if (map != nullptr) bytes += map->planes.size() * sizeof(StoredValue);
  }
  std::set<const Texture*> shown;
  for (const TextureSet& texture_set : inputs.textures.texture_sets) {
    for (const auto& texture : texture_set.textures) {
      if (shown.insert(texture.get()).second) bytes += texture->texels.size() * sizeof(LinearRgb);
    }
  }
  return bytes;
}

}  // namespace crowdface
