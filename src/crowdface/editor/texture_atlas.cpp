// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/texture_atlas.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "crowdface/core/parallel.h"
#include "crowdface/io/image.h"
#include "crowdface/pictures/page_pictures.h"
#include "crowdface/render/shading.h"

namespace crowdface {
namespace {

// Maximum width and height, in texels, of one cell and of the whole atlas.
constexpr int kMaxCellTexels = 2048, kMaxAtlasTexels = 4096;

std::array<std::uint8_t, 3> colour_texel(const LinearRgb& light) {
  return {srgb_byte(light[0]), srgb_byte(light[1]), srgb_byte(light[2])};
}

}  // namespace

TextureAtlas::TextureAtlas(const Inputs& inputs) : inputs_(inputs) {
  const HeadTextures& textures = inputs.textures;
  int largest = 1;
  if (textures.are_blended()) {
    for (const auto& picture : textures.blended.layout.pictures) {
      largest = std::max({largest, picture.width, picture.height});
    }
    cell_of_polygon_ = textures.blended.layout.picture_of_polygon;
    cell_count_ = static_cast<std::uint32_t>(textures.blended.layout.pictures.size());
  } else {
    const auto first = std::ranges::find_if(
        textures.texture_sets,
        [](const TextureSet& texture_set) { return !texture_set.textures.empty(); });
    if (first == textures.texture_sets.end()) return;
    cell_of_polygon_ = first->texture_of_polygon;
    cell_count_ = static_cast<std::uint32_t>(first->textures.size());
    for (const TextureSet& texture_set : textures.texture_sets) {
      for (const auto& texture : texture_set.textures) {
        largest = std::max({largest, texture->width, texture->height});
      }
    }
  }
  columns_ = static_cast<int>(std::ceil(std::sqrt(cell_count_)));
  rows_ = (static_cast<int>(cell_count_) + columns_ - 1) / columns_;
  cell_px_ = std::min({largest, kMaxCellTexels, kMaxAtlasTexels / columns_});
}

TextureCoordinates TextureAtlas::coordinates() const {
  const Topology& topology = inputs_.head_set.topology;
  const TextureCoordinates& uvs = inputs_.head_set.uvs;
  if (cell_count_ < 2) return uvs;
  TextureCoordinates placed = TextureCoordinates::Zero(uvs.rows(), 2);
  // Shrink the used part of each cell by half a texel at each side, so that texture filtering does
  // not mix the colours of neighbouring cells.
  const double margin = 0.5 / cell_px_;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::uint32_t cell = cell_of_polygon_[static_cast<std::size_t>(f)];
    if (cell == TextureSet::kNone) continue;
    const auto corners = topology.face_uvs(f);
    Eigen::RowVector2d middle = Eigen::RowVector2d::Zero();
    for (const std::uint32_t uv : corners) middle += uvs.row(uv);
    const Eigen::RowVector2d tile = (middle / static_cast<double>(corners.size())).array().floor();
    const auto [row, column] = std::div(static_cast<int>(cell), columns_);
    const Eigen::RowVector2d corner(column, rows_ - 1 - row);
    for (const std::uint32_t uv : corners) {
      const Eigen::RowVector2d inside =
          (uvs.row(uv) - tile).cwiseMax(margin).cwiseMin(1 - margin) + corner;
      placed.row(uv) = inside.cwiseQuotient(Eigen::RowVector2d(columns_, rows_));
    }
  }
  return placed;
}

bool TextureAtlas::has_textures_of(Index head) const {
  const HeadTextures& textures = inputs_.textures;
  const auto h = static_cast<std::size_t>(head);
  if (!textures.are_blended())
    return !textures.texture_sets.empty() && !textures.texture_sets[h].textures.empty();
  const auto& maps = textures.blended.maps;
  return std::ranges::any_of(maps, [&](const auto& map) { return map[h] != nullptr; });
}

std::optional<std::string> TextureAtlas::head_jpeg(Index head) const {
  if (!has_textures_of(head)) return std::nullopt;
  return colour_jpeg(*texture_set_of_head(inputs_.textures, head, cell_px_));
}

std::string TextureAtlas::colour_jpeg(const TextureLayer& layer) const {
  return to_jpeg(layer, albedo_of(SurfaceKind::kSkin), colour_texel);
}

std::string TextureAtlas::normal_map_jpeg(const TextureLayer& slopes) const {
  return to_jpeg(slopes, LinearRgb::Zero(), normal_texel);
}

std::string TextureAtlas::to_jpeg(const TextureLayer& layer, const LinearRgb& default_colour,
                                  Texel (*texel_of)(const LinearRgb&)) const {
  std::vector<const Texture*> shown(cell_count_, nullptr);
  for (std::size_t f = 0; f < layer.texture_of_polygon.size(); ++f) {
    if (layer.texture_of_polygon[f] == TextureLayer::kNone ||
        cell_of_polygon_[f] == TextureLayer::kNone)
      continue;
    const Texture*& texture = shown[cell_of_polygon_[f]];
    if (texture == nullptr) texture = layer.textures[layer.texture_of_polygon[f]].get();
  }
  const Texture* only = cell_count_ == 1 ? shown.front() : nullptr;  // is not resized
  const int width = only != nullptr ? only->width : columns_ * cell_px_;
  const int height = only != nullptr ? only->height : rows_ * cell_px_;
  const auto side = static_cast<float>(cell_px_);
  const auto colour_of_texel = [&](int x, int y) -> LinearRgb {
    if (only != nullptr) return only->texels[static_cast<std::size_t>(y * width + x)];
    const auto cell = static_cast<std::size_t>(y / cell_px_ * columns_ + x / cell_px_);
    const Texture* texture = cell < shown.size() ? shown[cell] : nullptr;
    if (texture == nullptr) return default_colour;
    return colour_at(*texture, {(static_cast<float>(x % cell_px_) + 0.5F) / side,
                                1 - (static_cast<float>(y % cell_px_) + 0.5F) / side});
  };
  std::vector<Texel> texels(static_cast<std::size_t>(width * height));
  parallel_for_each(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      texels[static_cast<std::size_t>(y * width + x)] = texel_of(colour_of_texel(x, y));
    }
  });
  return encode_jpeg(width, height, {texels.data()->data(), 3 * texels.size()});
}

}  // namespace crowdface
