// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/crowd_glb_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "crowdface/io/image.h"
#include "crowdface/pictures/surfaces.h"
#include "crowdface/render/eyeballs.h"
#include "crowdface/render/rgb8_image.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/vertex_colours.h"
#include "crowdface/run/face_texture_encoder.h"

namespace crowdface {
namespace {

/// A material with the same colour as in renders. Surfaces that renders omit (lashes, shells over
/// the eye) are transparent in GLB files, because opaque surfaces without a texture would hide the
/// eye.
GlbMaterial glb_material(const std::string& name, SurfaceKind kind,
                         const std::optional<Eigen::Array3f>& paint) {
  const LinearRgb colour = paint ? from_srgb(*paint) : albedo_of(kind);
  const float opacity = kind == SurfaceKind::kHidden ? 0.0F : 1.0F;
  return {name, {colour(0), colour(1), colour(2), opacity}};
}

/// Returns a PNG image of a whole eyeball with its iris, seen from the front.
std::string iris_png() {
  constexpr int kSide = 64;
  const EyeballSphere eye{Eigen::Vector3f::Zero(), 1};
  const Eigen::Vector3f gaze = Eigen::Vector3f::UnitZ();
  const auto at = [](int pixel) { return (2 * static_cast<float>(pixel) + 1) / kSide - 1; };
  Rgb8Image picture(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto colour = to_srgb8(eye_albedo(eye, gaze, {at(x), at(y), 0.5F}));
      std::copy(colour.begin(), colour.end(), picture.at(x, y));
    }
  }
  return encode_png(kSide, kSide, 3, picture.pixels);
}

/// Eyes with irises that look the same as in renders. The texture coordinates are computed on the
/// eyes of the mean head, and all faces use these coordinates.
std::optional<GlbOverlay> painted_eyes(const Config& config, const Inputs& inputs,
                                       const Surfaces& surfaces) {
  const auto eyes = eye_coordinates(inputs.head_set.topology, surfaces, mean_head(inputs.head_set),
                                    config.faces.front);
  if (!eyes) return std::nullopt;
  GlbOverlay overlay{iris_png(), {}};
  for (Index v = 0; v < eyes->rows(); ++v) {
    std::array<std::uint16_t, 2> place{};
    for (Index c = 0; c < 2; ++c) {
      const float share = std::clamp(((*eyes)(v, c) + 1) / 2, 0.0F, 1.0F);
      place[static_cast<std::size_t>(c)] = static_cast<std::uint16_t>(std::lround(65535 * share));
    }
    overlay.uvs.push_back(place);
  }
  return overlay;
}

/// Returns for each polygon the image that is the polygon's texture of the kind `kind` (such as a
/// colour or normal map). The image is given as an index into `held`; kNoIndex if the polygon has
/// no such texture. Returns an empty list if no polygon has such a texture.
/// \param held  the images of the GLB file
std::vector<std::uint32_t> images_of(const std::vector<GlbPicture>& held, const Inputs& inputs,
                                     TextureKind kind) {
  std::size_t first = 0;
  const auto of_textures = [&](const HeadTextures& textures) {
    std::vector<std::uint32_t> images;
    for (const std::uint32_t picture : textures.blended.layout.picture_of_polygon) {
      const auto image = std::find_if(held.begin(), held.end(), [&](const GlbPicture& one) {
        return picture != kNoIndex && one.picture_index == first + picture;
      });
      images.push_back(image == held.end() ? kNoIndex
                                           : static_cast<std::uint32_t>(image - held.begin()));
    }
    return images;
  };
  if (kind == TextureKind::kColour) {
    return inputs.textures.are_blended() ? of_textures(inputs.textures)
                                         : std::vector<std::uint32_t>();
  }
  first = inputs.textures.names.size();
  for (const HeadTextures& maps : inputs.other_textures) {
    if (maps.names.front().kind == kind) return of_textures(maps);
    first += maps.names.size();
  }
  return {};
}

/// Adds one material for each distinct combination of material name, surface kind and textures that
/// occurs among the polygons.
void add_materials(const Inputs& inputs, const std::vector<GlbPicture>& held,
                   const Surfaces& surfaces, GlbOptions& options) {
  const std::vector<std::uint32_t> colours = images_of(held, inputs, TextureKind::kColour);
  const std::vector<std::uint32_t> normals = images_of(held, inputs, TextureKind::kNormal);
  const std::vector<std::uint32_t> roughness = images_of(held, inputs, TextureKind::kRoughness);
  const auto at = [](const std::vector<std::uint32_t>& images, std::size_t face) {
    return images.empty() ? kNoIndex : images[face];
  };
  const auto image = [](std::uint32_t number) {
    return number == kNoIndex ? std::nullopt : std::optional<std::size_t>(number);
  };
  using Look = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, SurfaceKind>;
  std::map<Look, std::uint32_t> known;
  for (std::size_t f = 0; f < options.polygon_materials.size(); ++f) {
    const std::uint32_t material = options.polygon_materials[f];
    const std::uint32_t picture = at(colours, f);
    const SurfaceKind kind = surfaces.kinds[f];
    const auto [row, is_new] =
        known.emplace(Look(material, picture, at(normals, f), at(roughness, f), kind),
                      static_cast<std::uint32_t>(known.size()));
    options.polygon_materials[f] = row->second;
    if (!is_new) continue;
    const auto paint =
        surfaces.polygon_colours.empty() ? std::nullopt : surfaces.polygon_colours[f];
    GlbMaterial made = glb_material(inputs.materials.names[material], kind, paint);
    made.uses_overlay =
        options.overlay && kind == SurfaceKind::kEye && !paint && picture == kNoIndex;
    if (picture != kNoIndex || options.has_colours) made.colour = {1, 1, 1, made.colour[3]};
    made.image = image(picture);
    made.normal_image = image(at(normals, f));
    made.roughness_image = image(at(roughness, f));
    options.materials.push_back(std::move(made));
  }
  const auto is_overlaid = [](const GlbMaterial& material) { return material.uses_overlay; };
  if (std::none_of(options.materials.begin(), options.materials.end(), is_overlaid)) {
    options.overlay.reset();
  }
}

}  // namespace

GlbOptions glb_options(const Config& config, const Inputs& inputs, const std::string& shared) {
  GlbOptions options;
  if (!shared.empty()) options.shared_folder = shared;
  options.unit = config.faces.units;
  options.up = config.faces.up;
  options.front = config.faces.front;
  options.polygon_materials = inputs.materials.material_of_polygon;
  options.point_names = inputs.points.names;
  options.skin = inputs.rig.skin;
  for (const Shape& shape : inputs.shapes.shapes) {
    options.targets.push_back({shape.name, shape.moves.vertices});
  }
  const std::vector<GlbPicture> held = glb_pictures(config, inputs);
  const std::vector<std::string> names = face_picture_paths(config, inputs, "_");
  for (std::size_t i = 0; i < held.size(); ++i) {
    const std::string stem = std::filesystem::path(names[i]).stem().string();
    options.images.push_back(
        {held[i].format == TextureFormat::kJpeg ? "image/jpeg" : "image/png", stem.substr(1)});
  }
  const Surfaces surfaces = surfaces_of(config, inputs);
  options.has_colours = !inputs.vertex_colours.empty();
  if (!options.has_colours) options.overlay = painted_eyes(config, inputs, surfaces);
  add_materials(inputs, held, surfaces, options);
  return options;
}

GlbOptions glb_options(const Config& config, const Inputs& inputs, const std::string& shared,
                       const MeshLevel& level) {
  GlbOptions options = glb_options(config, inputs, shared);
  if (level.is_whole_mesh()) return options;
  const DetailLevel& detail = *level.face_level;
  options.polygon_materials = select_rows(options.polygon_materials, detail.source_faces);
  for (std::size_t t = 0; t < options.targets.size(); ++t) {
    options.targets[t].vertices = detail.restrict_rows(inputs.shapes.shapes[t].moves).vertices;
  }
  if (options.overlay) options.overlay->uvs = select_rows(options.overlay->uvs, detail.vertices);
  options.skin.influences = select_rows(options.skin.influences, detail.vertices);
  options.vertex_ids = detail.vertices;
  options.point_names.clear();  // only the whole mesh has points
  return options;
}

}  // namespace crowdface
