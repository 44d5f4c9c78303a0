// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/glb_form.h"

#include <map>
#include <utility>

#include "crowdface/render/shading.h"
#include "crowdface/render/surface_kind.h"

namespace crowdface {
namespace {

/// The colour of the renders. What they do not draw (lashes, shells over the eye) cannot be seen
/// here either: without its texture it would hide the eye.
GlbMaterial glb_material(const std::string& name) {
  const SurfaceKind kind = surface_kind_of_material(name);
  const Light colour = albedo_of(kind);
  const float opacity = kind == SurfaceKind::kHidden ? 0.0F : 1.0F;
  return {name, {colour(0), colour(1), colour(2), opacity}};
}

/// A material for each that faces have together with a picture of their own textures.
void add_textured_materials(const Config& config, const Inputs& inputs, GlbOptions& options) {
  options.images = inputs.textures.names.size();
  if (config.textures.formats.front() == TextureFormat::kJpeg) options.image_type = "image/jpeg";
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  for (std::size_t f = 0; f < options.face_materials.size(); ++f) {
    const std::uint32_t material = options.face_materials[f];
    const std::uint32_t picture = inputs.textures.blended.layout.of_face[f];
    const auto [row, is_new] =
        known.emplace(std::pair(material, picture), static_cast<std::uint32_t>(known.size()));
    options.face_materials[f] = row->second;
    if (!is_new) continue;
    GlbMaterial made = glb_material(inputs.materials.names[material]);
    if (picture != kNoIndex) {
      made.colour = {1, 1, 1, made.colour[3]};
      made.image = picture;
    }
    options.materials.push_back(std::move(made));
  }
}

}  // namespace

GlbOptions glb_options(const Config& config, const Inputs& inputs) {
  GlbOptions options;
  options.unit = config.faces.units;
  options.up = config.faces.up;
  options.front = config.faces.front;
  options.face_materials = inputs.materials.of_face;
  options.points = inputs.points.names;
  for (const Shape& shape : inputs.shapes.shapes) {
    options.targets.push_back({shape.name, shape.moves.vertices});
  }
  if (inputs.textures.blend()) {
    add_textured_materials(config, inputs, options);
  } else {
    for (const std::string& name : inputs.materials.names) {
      options.materials.push_back(glb_material(name));
    }
  }
  return options;
}

GlbOptions glb_options(GlbOptions whole, const DetailLevel& level, const ShapeSet& shapes) {
  if (!whole.face_materials.empty()) {
    std::vector<std::uint32_t> materials;
    for (const std::uint32_t face : level.faces) materials.push_back(whole.face_materials[face]);
    whole.face_materials = std::move(materials);
  }
  for (std::size_t t = 0; t < whole.targets.size(); ++t) {
    whole.targets[t].vertices = level.of(shapes.shapes[t].moves).vertices;
  }
  whole.vertex_ids = level.vertices;
  whole.points.clear();  // those of the whole mesh are the face's
  return whole;
}

}  // namespace crowdface
