// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/skin_specular.h"

#include <algorithm>
#include <vector>

namespace crowdface {

float skin_lightness(const Texture& texture) {
  constexpr std::size_t kEvery = 61;
  std::vector<float> light;
  for (std::size_t i = 0; i < texture.texels.size(); i += kEvery) {
    light.push_back(texture.texels[i].mean());
  }
  if (light.empty()) return 0;
  const auto at = light.begin() + static_cast<std::ptrdiff_t>(light.size() * 7 / 10);
  std::nth_element(light.begin(), at, light.end());
  return *at;
}

float skin_specular_factor(const LinearRgb& albedo, float skin_lightness) {
  constexpr float kHair = 0.15F, kSkin = 0.7F, kMin = 0.12F;
  if (skin_lightness <= 0) return 1;
  const float skin = (albedo.mean() / skin_lightness - kHair) / (kSkin - kHair);
  return kMin + (1 - kMin) * std::clamp(skin, 0.0F, 1.0F);
}

}  // namespace crowdface
