// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_textures.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "crowdface/core/file.h"
#include "crowdface/heads/image_values.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

struct TextureFile {
  std::shared_ptr<const Texture> texture;
  Digest content;
};

/// Reads a texture. While the texture exists, its size counts towards the limit of image memory.
TextureFile read_texture(const fs::path& path, int max_px) {
  struct Kept {
    ImageMemory memory;
    Texture texture;
  };
  const Image image = read_image(path, {.allows_jpeg = true});
  const auto texels = static_cast<std::uint64_t>(std::min(image.width, max_px)) *
                      static_cast<std::uint64_t>(std::min(image.height, max_px));
  ImageMemory memory = reserve_image_memory(path, texels * sizeof(LinearRgb));
  const ImageRows light = linear_light_of(image);
  const auto kept = std::make_shared<const Kept>(
      Kept{std::move(memory), shrunk_texture(light.width, light.height, max_px, light.read_row)});
  return {{kept, &kept->texture}, hash_file(path).digest};
}

Texture texture_of(int width, int height, const std::vector<std::uint8_t>& srgb, int max_px) {
  const std::array<float, 256>& light = linear_of_srgb8();
  return shrunk_texture(width, height, max_px, [&](int y, std::span<LinearRgb> texels) {
    const std::uint8_t* at =
        srgb.data() + 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(y);
    for (LinearRgb& texel : texels) {
      for (int c = 0; c < 3; ++c) texel[c] = light[*at++];
    }
  });
}

/// Side length, in texels, of normal and roughness maps in renders. The maps are downscaled more
/// than colours, because relief finer than a pixel only causes noise.
int shading_map_texels(int max_px) {
  return std::max(1, max_px / 2);
}

/// Converts a normal map or a roughness map to a texture for renders. Each texel of the texture is
/// the mean of the map's texels that it covers. In a normal map, this mean normal is then converted
/// to the slopes of the surface.
/// \param normals  true: a normal map; false: a roughness map
Texture shading_map_of(const BlendedPicture& picture, bool normals, int max_px) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  const std::size_t middle = channels / 2;
  const auto row = [&](int y, std::span<LinearRgb> texels) {
    const std::uint16_t* at =
        picture.values_16_bit.data() +
        channels * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(y);
    for (LinearRgb& texel : texels) {
      texel = {static_cast<float>(at[0]), static_cast<float>(at[middle]),
               static_cast<float>(at[channels - 1])};
      at += channels;
    }
  };
  Texture shrunk = shrunk_texture(picture.width, picture.height, max_px, row);
  for (LinearRgb& texel : shrunk.texels) {
    texel = picture.low + picture.step * texel;
    if (!normals) continue;
    texel = 2 * texel - 1;
    texel /= std::max(texel[2], 1e-3F);
  }
  return shrunk;
}

Texture shading_map_of(const TextureMap& map, int max_px) {
  Texture shrunk =
      shrunk_texture(map.width, map.height, max_px, [&](int y, std::span<LinearRgb> texels) {
        const StoredValue *first = map.row(0, y), *last = map.row(map.coding.channels - 1, y);
        for (std::size_t x = 0; x < texels.size(); ++x) {
          texels[x] = {static_cast<float>(first[x]), static_cast<float>(last[x]), 0};
        }
      });
  for (LinearRgb& texel : shrunk.texels) texel = map.coding.low + map.coding.step * texel;
  return shrunk;
}

/// The layer of a texture set for a rendered kind of texture.
TextureLayer& layer_of(TextureKind kind, TextureSet& texture_set) {
  if (kind == TextureKind::kColour) return texture_set;
  return kind == TextureKind::kNormal ? texture_set.slopes : texture_set.roughness;
}

}  // namespace

Texture texture_of(const BlendedPicture& colours, int max_px) {
  return texture_of(colours.width, colours.height, colours.srgb, max_px);
}

int max_rendered_texels(const Config::ContactSheet& sheet) {
  constexpr int kMin = 1024;
  return std::max(kMin, 2 * sheet.cell);
}

bool are_any_rendered(const std::vector<HeadTextures>& maps) {
  return std::ranges::any_of(maps, [](const HeadTextures& of_kind) {
    return is_shown_in_previews(of_kind.names.front().kind);
  });
}

FaceTextureSet::FaceTextureSet(const HeadTextures& colours, const std::vector<HeadTextures>& maps,
                               Index target, int max_px)
    : max_px_(max_px) {
  const auto add_kind = [&](const HeadTextures& textures) {
    const TextureLayout& layout = textures.blended.layout;
    const TextureKind kind = textures.names.front().kind;
    for (std::size_t p = 0; p < layout.pictures.size(); ++p) image_indices_.push_back({kind, p});
    if (kind != TextureKind::kColour && !is_shown_in_previews(kind)) return;
    TextureLayer& layer = layer_of(kind, texture_set_);
    layer.texture_of_polygon = layout.picture_of_polygon;
    layer.textures.resize(layout.pictures.size());
  };
  if (colours.are_blended()) {
    add_kind(colours);
  } else if (auto of_target = texture_set_of_head(colours, target, max_px)) {
    texture_set_ = std::move(*of_target);
  } else {
    texture_set_.texture_of_polygon.assign(maps.front().blended.layout.picture_of_polygon.size(),
                                           TextureLayer::kNone);
  }
  for (const HeadTextures& of_kind : maps) add_kind(of_kind);
}

void FaceTextureSet::add(std::size_t picture, const BlendedPicture& blended) {
  const auto [kind, number] = image_indices_[picture];
  const bool is_colour = kind == TextureKind::kColour;
  if (!is_colour && !is_shown_in_previews(kind)) return;
  layer_of(kind, texture_set_).textures[number] = std::make_shared<const Texture>(
      is_colour
          ? texture_of(blended, max_px_)
          : shading_map_of(blended, kind == TextureKind::kNormal, shading_map_texels(max_px_)));
}

std::uint64_t FaceTextureSet::memory_bytes(const HeadTextures& colours,
                                           const std::vector<HeadTextures>& maps, int max_px) {
  std::uint64_t texels = 0;
  const auto add_kind = [&](const HeadTextures& textures, int most) {
    for (const TextureLayout::Picture& picture : textures.blended.layout.pictures) {
      texels += static_cast<std::uint64_t>(std::min(picture.width, most)) *
                static_cast<std::uint64_t>(std::min(picture.height, most));
    }
  };
  add_kind(colours, max_px);
  for (const HeadTextures& of_kind : maps) {
    if (is_shown_in_previews(of_kind.names.front().kind))
      add_kind(of_kind, shading_map_texels(max_px));
  }
  return texels * sizeof(LinearRgb);
}

void add_shading_maps_of_head(const std::vector<HeadTextures>& maps, Index head, int max_px,
                              TextureSet& texture_set) {
  for (const HeadTextures& of_kind : maps) {
    const TextureKind kind = of_kind.names.front().kind;
    if (!is_shown_in_previews(kind)) continue;
    TextureLayer& layer = layer_of(kind, texture_set);
    layer.texture_of_polygon = of_kind.blended.layout.picture_of_polygon;
    for (std::size_t p = 0; p < of_kind.names.size(); ++p) {
      const TextureMap* map = of_kind.blended.maps[p][static_cast<std::size_t>(head)].get();
      layer.textures.push_back(map == nullptr ? nullptr
                                              : std::make_shared<const Texture>(shading_map_of(
                                                    *map, shading_map_texels(max_px))));
      if (map != nullptr) continue;
      std::ranges::replace(layer.texture_of_polygon, static_cast<std::uint32_t>(p),
                           TextureLayer::kNone);
    }
  }
}

std::optional<TextureSet> texture_set_of_head(const HeadTextures& textures, Index head,
                                              int max_px) {
  const auto h = static_cast<std::size_t>(head);
  if (!textures.texture_sets.empty()) return textures.texture_sets[h];
  if (!textures.are_blended()) return std::nullopt;
  const TextureLayout& layout = textures.blended.layout;
  TextureSet texture_set;
  std::vector<std::uint32_t> row(layout.pictures.size(), TextureSet::kNone);
  for (std::size_t p = 0; p < row.size(); ++p) {
    const TextureMap* map = textures.blended.maps[p][h].get();
    if (map == nullptr) continue;
    row[p] = static_cast<std::uint32_t>(texture_set.textures.size());
    texture_set.textures.push_back(std::make_shared<const Texture>(
        texture_of(map->width, map->height, srgb8_of(*map), max_px)));
  }
  for (const std::uint32_t picture : layout.picture_of_polygon) {
    texture_set.texture_of_polygon.push_back(picture == kNoIndex ? TextureSet::kNone
                                                                 : row[picture]);
  }
  return texture_set;
}

HeadTextures load_render_textures(FoundTextureFiles found, int max_px) {
  HeadTextures result;
  result.warnings = std::move(found.warnings);
  std::map<fs::path, TextureFile> shelf;  // each file is read once, even if several heads name it
  Hasher hasher;
  for (HeadTextureFiles& placed : found.heads) {
    TextureSet texture_set;
    hasher.add(placed.files.size());
    for (const HeadTextureFiles::File& file : placed.files) {
      const auto [known, is_new] = shelf.try_emplace(file.path);
      if (is_new) known->second = read_texture(file.path, max_px);
      texture_set.textures.push_back(known->second.texture);
      hasher.add(known->second.content);
    }
    texture_set.texture_of_polygon = std::move(placed.file_of_polygon);
    hasher.add_array(std::span<const std::uint32_t>(texture_set.texture_of_polygon));
    result.texture_sets.push_back(std::move(texture_set));
  }
  result.digest = hasher.digest();
  return result;
}

}  // namespace crowdface
