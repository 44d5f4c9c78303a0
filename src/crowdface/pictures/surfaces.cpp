// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/surfaces.h"

#include <algorithm>
#include <optional>

namespace crowdface {

Surfaces surfaces_of(const Config& config, const Inputs& inputs) {
  const std::vector<std::uint32_t>& of_face = inputs.materials.of_face;
  const std::size_t count = inputs.materials.names.size();
  std::vector<SurfaceKind> kinds(count);
  std::vector<std::optional<Eigen::Array3f>> paints(count);
  std::vector<bool> chosen(count);
  for (std::size_t m = 0; m < count; ++m) {
    const std::string& material = inputs.materials.names[m];
    const auto choice = config.output.surfaces.find(material);
    chosen[m] = choice != config.output.surfaces.end();
    kinds[m] = chosen[m] ? choice->second.kind : surface_kind_of_material(material);
    if (!chosen[m] || !choice->second.colour) continue;
    const auto& rgb = *choice->second.colour;
    paints[m] = Eigen::Array3f(rgb[0], rgb[1], rgb[2]) / 255.0F;
  }
  Surfaces surfaces;
  const bool any_paint =
      std::any_of(paints.begin(), paints.end(), [](auto& p) { return p.has_value(); });
  for (const std::uint32_t material : of_face) {
    surfaces.kinds.push_back(kinds[material]);
    if (any_paint) surfaces.paints.push_back(paints[material]);
  }
  // What no material names but has an eyeball's shape is an eye too.
  std::vector<bool> eyeball(static_cast<std::size_t>(inputs.components.count()), false);
  for (const Part& part : inputs.parts.parts) {
    for (const std::uint32_t c : part.components) eyeball[c] = part.eyeball;
  }
  for (std::size_t f = 0; f < surfaces.kinds.size(); ++f) {
    const std::uint32_t first = inputs.faces.topology.face(static_cast<Index>(f))[0];
    if (surfaces.kinds[f] == SurfaceKind::kSkin && eyeball[inputs.components.of_vertex[first]] &&
        !chosen[of_face[f]]) {
      surfaces.kinds[f] = SurfaceKind::kEye;
    }
  }
  if (inputs.textures.any() || any_is_shown(inputs.maps)) surfaces.uvs = inputs.faces.uvs;
  return surfaces;
}

}  // namespace crowdface
