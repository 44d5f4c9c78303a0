// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/surfaces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "crowdface/core/error.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/mesh/polygon_sample.h"

namespace crowdface {
namespace {

/// Mean of an image channel over some polygons of the mesh, estimated from samples within each
/// polygon.
/// \param value  value(image, x, y) returns the channel at a pixel
template <class Value>
double covered(const Image& image, const Topology& topology, const TextureCoordinates& uvs,
               const std::vector<Index>& faces, const Value& value) {
  constexpr std::size_t kSamples = 4096, kMin = 4;
  const std::size_t each = std::max(kMin, kSamples / std::max<std::size_t>(1, faces.size()));
  double sum = 0;
  std::size_t count = 0;
  const auto part = [](double number) { return number - std::floor(number); };
  const auto sample = [&](const Eigen::RowVector2d& uv) {
    const auto pixel = [&](double at, int size) {
      return std::min(size - 1, static_cast<int>(part(at) * size));
    };
    sum += value(image, pixel(uv.x(), image.width), pixel(1 - uv.y(), image.height));
    ++count;
  };
  for (const Index f : faces) {
    const auto rows = topology.face_uvs(f);
    if (rows.size() < 3 || std::ranges::find(rows, kNoIndex) != rows.end()) continue;
    for (std::size_t s = 0; s < each; ++s) {
      const PolygonSample at = polygon_sample(count, rows.size());
      const Eigen::RowVector2d first = uvs.row(rows[0]);
      sample(first + at.s * (uvs.row(rows[at.second_corner]) - first) +
             at.t * (uvs.row(rows[at.second_corner + 1]) - first));
    }
  }
  return count == 0 ? 1 : sum / static_cast<double>(count);
}

/// Whether a material is mostly transparent on these polygons; this is true for shells over the
/// eyes and for lash cards.
bool is_see_through(const SurfaceMaterial& material, const HeadSet& head_set,
                    const std::vector<Index>& of_material) {
  constexpr double kSolid = 0.9;
  if (material.opacity < kSolid) return true;
  const std::filesystem::path& file =
      material.opacity_map.empty() ? material.colour_map : material.opacity_map;
  if (file.empty()) return false;
  try {
    const Image image = read_image(file, {.allows_jpeg = true});
    const bool is_alpha = image.alpha_channel >= 0;
    if (!is_alpha && material.opacity_map.empty()) return false;
    const int channel = is_alpha ? image.alpha_channel : 0;
    return covered(image, head_set.topology, head_set.uvs, of_material,
                   [&](const Image& of, int x, int y) {
                     return static_cast<double>(of.at(x, y, channel));
                   }) < kSolid;
  } catch (const RecoverableError&) {
    return false;  // reading the textures reports the error
  }
}

/// For each material, whether it is transparent. Materials that the skin uses count as opaque.
std::vector<bool> see_through_materials(const Inputs& inputs) {
  const Topology& topology = inputs.head_set.topology;
  std::vector<std::vector<Index>> faces(inputs.materials.names.size());
  std::vector<bool> is_skin(faces.size(), false), see_through(faces.size(), false);
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::uint32_t material =
        inputs.materials.material_of_polygon[static_cast<std::size_t>(f)];
    faces[material].push_back(f);
    const std::uint32_t component = inputs.components.component_of_vertex[topology.face(f)[0]];
    if (component == inputs.components.largest()) is_skin[material] = true;
  }
  if (std::ranges::find(is_skin, false) == is_skin.end()) return see_through;
  const ObjFile& first = inputs.head_files.front();
  const std::vector<SurfaceMaterial> materials = surface_materials_of(
      inputs.materials.names, find_material_files(first.material_path(), first.material_libraries));
  for (std::size_t m = 0; m < faces.size(); ++m) {
    see_through[m] = !is_skin[m] && is_see_through(materials[m], inputs.head_set, faces[m]);
  }
  return see_through;
}

}  // namespace

Surfaces surfaces_of(const Config& config, const Inputs& inputs) {
  const std::vector<std::uint32_t>& of_face = inputs.materials.material_of_polygon;
  const std::size_t count = inputs.materials.names.size();
  std::vector<SurfaceKind> kinds(count);
  std::vector<std::optional<Eigen::Array3f>> paints(count);
  std::vector<bool> chosen(count);
  const std::vector<bool> see_through = see_through_materials(inputs);
  for (std::size_t m = 0; m < count; ++m) {
    const std::string& material = inputs.materials.names[m];
    const auto choice = config.output.surfaces.find(material);
    chosen[m] = choice != config.output.surfaces.end();
    kinds[m] = chosen[m] ? choice->second.kind : surface_kind_of_material(material);
    if (!chosen[m] && see_through[m]) kinds[m] = SurfaceKind::kHidden;
    if (!chosen[m] || !choice->second.colour) continue;
    const auto& rgb = *choice->second.colour;
    paints[m] = Eigen::Array3f(rgb[0], rgb[1], rgb[2]) / 255.0F;
  }
  Surfaces surfaces;
  const bool any_paint =
      std::any_of(paints.begin(), paints.end(), [](auto& p) { return p.has_value(); });
  for (const std::uint32_t material : of_face) {
    surfaces.kinds.push_back(kinds[material]);
    if (any_paint) surfaces.polygon_colours.push_back(paints[material]);
  }
  // Find eyeballs also by form: if a connected component has the form of an eyeball, its polygons
  // are eyes, whatever the name of their material is.
  std::vector<bool> eyeball(static_cast<std::size_t>(inputs.components.count()), false);
  for (const Part& part : inputs.parts.parts) {
    for (const std::uint32_t c : part.components) eyeball[c] = part.is_eyeball;
  }
  for (std::size_t f = 0; f < surfaces.kinds.size(); ++f) {
    const std::uint32_t first = inputs.head_set.topology.face(static_cast<Index>(f))[0];
    if (surfaces.kinds[f] == SurfaceKind::kSkin &&
        eyeball[inputs.components.component_of_vertex[first]] && !chosen[of_face[f]]) {
      surfaces.kinds[f] = SurfaceKind::kEye;
    }
  }
  if (inputs.textures.has_textures() || are_any_rendered(inputs.other_textures))
    surfaces.uvs = inputs.head_set.uvs;
  return surfaces;
}

}  // namespace crowdface
