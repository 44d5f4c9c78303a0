// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/attachment_surfaces.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/image_values.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"

namespace crowdface {
namespace {

/// Returns the opacity at pixel (x, y) of an opacity image: the alpha channel, or the first channel
/// if the image has no alpha channel.
float opacity_at(const Image& image, int x, int y) {
  const int channel = image.alpha_channel >= 0 ? image.alpha_channel : 0;
  return std::clamp(image.at(x, y, channel), 0.0F, 1.0F);
}

Texture opacity_texture(const Image& image, int max_px) {
  return shrunk_texture(image.width, image.height, max_px, [&](int y, std::span<LinearRgb> texels) {
    for (int x = 0; x < image.width; ++x) {
      texels[static_cast<std::size_t>(x)] = LinearRgb::Constant(opacity_at(image, x, y));
    }
  });
}

/// Weights colours by opacity, so that the colours of transparent texels do not bleed into the
/// visible texels next to them.
void weight_by_opacity(const Image& image, const ImageRows& light, int max_px,
                       const Texture& opacity, Texture& colours) {
  const Texture weighted =
      shrunk_texture(image.width, image.height, max_px, [&](int y, std::span<LinearRgb> texels) {
        light.read_row(y, texels);
        for (int x = 0; x < image.width; ++x) {
          texels[static_cast<std::size_t>(x)] *= opacity_at(image, x, y);
        }
      });
  constexpr float kMin = 0.01F;
  constexpr int kSpread = 4;
  std::vector<bool> painted;
  for (std::size_t t = 0; t < colours.texels.size(); ++t) {
    const float there = opacity.texels[t][0];
    painted.push_back(there > kMin);
    if (there > kMin) colours.texels[t] = weighted.texels[t] / there;
  }
  spread_colours(colours, std::move(painted), kSpread);
}

}  // namespace

const AttachmentSurface& AttachmentSurfaces::at(const Attachment& item) const {
  return surfaces_.get(&item, [&] {
    const PolygonMaterials named =
        polygon_materials(item.file.materials, item.file.topology.face_count());
    std::vector<AttachmentMaterial> materials;
    for (const SurfaceMaterial& material : surface_materials_of(named.names, item.materials)) {
      materials.emplace_back();
      try {
        materials.back() = material_of(material);
      } catch (const InvalidInput& error) {
        log_warning(concat(error.what(), "; pictures show the attachment without this material"));
      }
    }
    if (materials.empty()) materials.emplace_back();
    return std::make_unique<const AttachmentSurface>(
        item.file.topology, item.file.uvs, std::move(materials), named.material_of_polygon);
  });
}

AttachmentMaterial AttachmentSurfaces::material_of(const SurfaceMaterial& source) const {
  AttachmentMaterial material;
  if (source.colour) {
    material.colour = LinearRgb((*source.colour)[0], (*source.colour)[1], (*source.colour)[2]);
  }
  material.opacity_factor = source.opacity;
  if (!source.colour_map.empty()) {
    const Picture& picture = colour_maps_.get(source.colour_map, [&] {
      const Image image = read_image(source.colour_map, {.allows_jpeg = true});
      const ImageRows light = linear_light_of(image);
      Texture colours = shrunk_texture(image.width, image.height, max_px_, light.read_row);
      auto read = std::make_unique<Picture>();
      if (image.alpha_channel >= 0) {
        read->opacity = std::make_shared<const MipMap>(opacity_texture(image, max_px_));
        weight_by_opacity(image, light, max_px_, read->opacity->levels[0], colours);
      }
      read->colours = std::make_shared<const Texture>(std::move(colours));
      return read;
    });
    if (shows_textures_) {
      material.texture = picture.colours;
    } else if (!source.colour) {
      material.colour = albedo_of(SurfaceKind::kSkin);
    }
    material.opacity = picture.opacity;
  }
  if (!source.opacity_map.empty()) {
    material.opacity = opacity_maps_.get(source.opacity_map, [&] {
      return std::make_unique<std::shared_ptr<const MipMap>>(std::make_shared<const MipMap>(
          opacity_texture(read_image(source.opacity_map, {.allows_jpeg = true}), max_px_)));
    });
  }
  return material;
}

std::uint64_t attachment_texture_bytes(std::span<const Attachment* const> items, int max_px) {
  std::uint64_t bytes = 0;
  std::set<std::pair<std::filesystem::path, std::uint64_t>> known;
  const auto add = [&](const std::filesystem::path& picture, std::uint64_t textures) {
    if (picture.empty() || !known.emplace(picture, textures).second) return;
    try {
      const ImageSize size = read_image_size(picture, {.allows_jpeg = true});
      const int block = (std::max(size.width, size.height) + max_px - 1) / max_px;
      const auto texels = static_cast<std::uint64_t>(size.width / block + 1) *
                          static_cast<std::uint64_t>(size.height / block + 1);
      bytes += textures * sizeof(LinearRgb) * texels * 4 / 3;  // a mip map adds a third
    } catch (const RecoverableError&) {
      return;  // rendering continues without the texture
    }
  };
  for (const Attachment* item : items) {
    for (const SurfaceMaterial& material : item->materials.surface_materials) {
      add(material.colour_map, 2);
      add(material.opacity_map, 1);
    }
  }
  return bytes;
}

std::vector<AttachmentMesh> AttachmentSurfaces::meshes(
    const std::vector<PlacedAttachment>& placed) const {
  std::vector<AttachmentMesh> meshes;
  for (const PlacedAttachment& one : placed) {
    const std::array<float, 3> tint = one.look().tint();
    meshes.push_back({&at(*one.item), &one.positions, LinearRgb(tint[0], tint[1], tint[2])});
  }
  return meshes;
}

}  // namespace crowdface
