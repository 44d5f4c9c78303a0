// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/surfaces.h"

namespace crowdface {

Surfaces surfaces_of(const Config& config, const Inputs& inputs) {
  const std::vector<std::string>& materials = inputs.materials;
  Surfaces surfaces;
  for (const std::string& material : materials) {
    const auto chosen = config.output.surfaces.find(material);
    const bool by_name = chosen == config.output.surfaces.end();
    surfaces.kinds.push_back(by_name ? surface_kind_of_material(material) : chosen->second.kind);
    if (by_name || !chosen->second.colour) continue;
    surfaces.paints.resize(materials.size());
    const auto& rgb = *chosen->second.colour;
    surfaces.paints[surfaces.kinds.size() - 1] = Eigen::Array3f(rgb[0], rgb[1], rgb[2]) / 255.0F;
  }
  // What no material names but has an eyeball's shape is an eye too.
  std::vector<bool> eyeball(static_cast<std::size_t>(inputs.components.count()), false);
  for (const Part& part : inputs.parts.parts) {
    for (const std::uint32_t c : part.components) eyeball[c] = part.eyeball;
  }
  for (std::size_t f = 0; f < surfaces.kinds.size(); ++f) {
    const std::uint32_t first = inputs.faces.topology.face(static_cast<Index>(f))[0];
    if (surfaces.kinds[f] == SurfaceKind::kSkin && eyeball[inputs.components.of_vertex[first]] &&
        !config.output.surfaces.contains(materials[f])) {
      surfaces.kinds[f] = SurfaceKind::kEye;
    }
  }
  if (!inputs.textures.coats.empty()) surfaces.uvs = inputs.faces.uvs;
  return surfaces;
}

}  // namespace crowdface
