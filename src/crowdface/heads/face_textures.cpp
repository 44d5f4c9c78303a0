// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/face_textures.h"

#include <algorithm>
#include <set>

#include "crowdface/cast/face_area.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

/// Waves of colour that are longer than this are blended as a mean, shorter ones keep their contrast: brows,
/// lips' borders, freckles, stubble, pores.
constexpr double kDetailMm = 24;
/// Over so much of the surface the strength of detail is averaged.
constexpr double kStrengthMm = 48;

}  // namespace

FaceTextures::FaceTextures(const Config& config, const Inputs& inputs) {
  if (!inputs.textures.blend()) return;
  const Topology& topology = inputs.faces.topology;
  TextureBlending options;
  const auto iterations = [&](double size_mm) {
    return std::max<std::uint64_t>(
        1, iterations_of_size(OperatorKind::kLazy, size_mm, inputs.edge_length_mm));
  };
  options.scale = {iterations(kDetailMm), iterations(kStrengthMm)};
  options.areas = face_areas(topology, inputs.skin, mean_head(inputs.faces), FaceArea::kFront,
                             config.faces.front);
  options.of_target.assign(static_cast<std::size_t>(topology.vertex_count), false);
  for (const Part& part : inputs.parts.parts) {
    for (const std::uint32_t vertex : part.vertices) options.of_target[vertex] = true;
  }
  blender_ =
      std::make_unique<TextureBlender>(topology, inputs.faces.uvs, inputs.adjacency, inputs.regions,
                                       inputs.textures.blended, std::move(options));
}

std::uint64_t texture_bytes(const HeadTextures& textures) {
  std::set<const TextureMap*> maps;  // heads may share them
  for (const auto& of_picture : textures.blended.maps) {
    for (const auto& map : of_picture) maps.insert(map.get());
  }
  std::uint64_t bytes = 0;
  for (const TextureMap* map : maps) {
    if (map != nullptr) bytes += map->planes.size() * sizeof(Density);
  }
  std::set<const Texture*> shown;
  for (const TextureCoat& coat : textures.coats) {
    for (const auto& texture : coat.textures) {
      if (shown.insert(texture.get()).second) bytes += texture->texels.size() * sizeof(Light);
    }
  }
  return bytes;
}

}  // namespace crowdface
