// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/usda_part.h"

#include <utility>

#include "crowdface/core/text.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

UsdaMesh::Options mesh_options_of(const std::vector<UsdaPart::Material>& materials,
                                  std::vector<std::uint32_t> polygon_materials,
                                  const std::vector<std::string>& targets) {
  UsdaMesh::Options options{.polygon_materials = std::move(polygon_materials)};
  for (const UsdaPart::Material& material : materials) options.materials.push_back(material.name);
  for (const std::string& target : targets) options.targets.push_back({target, {}});
  return options;
}

}  // namespace

UsdaPart::UsdaPart(std::string name, const Topology& topology, const TextureCoordinates& uvs,
                   const std::vector<Material>& materials,
                   std::vector<std::uint32_t> polygon_materials,
                   const std::vector<std::string>& targets, GivenNormals fixed)
    : name_(std::move(name)),
      topology_(topology),
      fans_(topology_),
      mesh_(topology_, uvs, mesh_options_of(materials, std::move(polygon_materials), targets)),
      given_normals_(std::move(fixed)) {
  for (const Material& material : materials) surfaces_.push_back(material.surface);
}

void UsdaPart::add_mesh(EncodedFile& file, const std::string& root, const Positions& positions,
                        std::span<const Displacements> moves, const std::string& what) const {
  file.add("\n");
  require_finite(positions, topology_.vertex_count, what);
  Positions normals = vertex_normals(fans_, topology_, positions);
  given_normals_.copy_to(normals);
  mesh_.add(file, {root + "/face", name_, concat(root, '/', name_, "_materials")}, positions,
            normals, moves, what);
}

void UsdaPart::add_materials(EncodedFile& file, const std::string& root,
                             const PartLook& look) const {
  std::vector<UsdaSurface> surfaces = surfaces_;
  for (UsdaSurface& surface : surfaces) {
    for (std::size_t c = 0; c < look.tint.size(); ++c) surface.colour[c] *= look.tint[c];
    for (std::string* name : {&surface.colour_map, &surface.opacity_map}) {
      const std::size_t at = name->find(kLookPlaceholder);
      if (at != std::string::npos) name->replace(at, kLookPlaceholder.size(), look.name);
    }
  }
  file.add(usda_materials(root, name_ + "_materials", mesh_.materials(), surfaces));
}

}  // namespace crowdface
