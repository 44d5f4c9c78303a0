// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/skin_tones.h"

#include "crowdface/cast/compared_area.h"
#include "crowdface/core/parallel.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface {

std::vector<double> skin_tones(const Inputs& inputs) {
  constexpr int kStep = 16;
  if (!inputs.textures.are_blended()) return {};
  const HeadMaps& maps = inputs.textures.blended.maps;
  std::vector<double> tones(inputs.head_set.heads.size(), 0.0);
  parallel_for_each(tones.size(), [&](std::size_t h) {
    double sum = 0, count = 0;
    for (const auto& of_picture : maps) {
      const TextureMap* map = of_picture[h].get();
      if (map == nullptr) continue;
      for (int c = 0; c < map->coding.channels; ++c) {
        for (int y = kStep / 2; y < map->height; y += kStep) {
          const Density* row = map->row(c, y);
          for (int x = kStep / 2; x < map->width; x += kStep) {
            sum += row[x];
            ++count;
          }
        }
      }
    }
    if (count > 0) tones[h] = sum / count;
  });
  return tones;
}

HeadColourWeights::HeadColourWeights(const Config& config, const Inputs& inputs)
    : head_count_(inputs.head_set.heads.size()),
      region_area_fractions_(region_area_fractions(
          inputs.regions,
          compared_vertex_areas(inputs.head_set.topology, inputs.skin_components, inputs.mean_head,
                                ComparedArea::kFront, config.faces.front))) {}

std::vector<double> HeadColourWeights::weights_of(const Recipe& recipe) const {
  return face_colour_weights(recipe, head_count_, region_area_fractions_).weights_for_skin;
}

}  // namespace crowdface
