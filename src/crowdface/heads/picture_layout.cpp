// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/picture_layout.h"

#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// The first 40 letters, digits, hyphens and underscores of a material's name, for use in file
/// names.
std::string file_name_part(const std::string& material) {
  std::string name;
  for (const char c : material) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain || c == '-' || c == '_') name += c;
  }
  return name.substr(0, 40);
}

}  // namespace

std::vector<PictureSource> lay_out_pictures(const FoundTextureFiles& found, TextureLayout& layout) {
  layout.tile_of_polygon = found.tile_of_polygon;
  layout.picture_of_polygon.assign(found.tile_of_polygon.size(), kNoIndex);
  std::vector<PictureSource> first;
  std::map<std::pair<std::size_t, std::uint32_t>, std::uint32_t> known;
  for (std::size_t f = 0; f < layout.picture_of_polygon.size(); ++f) {
    for (std::size_t h = 0; h < found.heads.size(); ++h) {
      const std::uint32_t row = found.heads[h].file_of_polygon[f];
      if (row == kNoIndex) continue;
      const auto [picture, is_new] =
          known.emplace(std::pair(h, row), static_cast<std::uint32_t>(first.size()));
      if (is_new) first.push_back({h, row, static_cast<Index>(f)});
      layout.picture_of_polygon[f] = picture->second;
      break;
    }
  }
  layout.pictures.resize(first.size());
  return first;
}

std::vector<PictureName> picture_names(const FoundTextureFiles& found,
                                       const std::vector<PictureSource>& pictures,
                                       const PolygonMaterials& materials) {
  std::map<fs::path, std::string> parts;
  std::set<std::string> taken;
  for (const PictureSource& picture : pictures) {
    const fs::path& file = found.heads[picture.head].files[picture.file_index].name;
    if (parts.contains(file)) continue;
    const auto face = static_cast<std::size_t>(picture.polygon);
    std::string part = file_name_part(materials.names[materials.material_of_polygon[face]]);
    if (part.empty() || taken.contains(part)) part += std::to_string(parts.size() + 1);
    taken.insert(part);
    parts.emplace(file, part);
  }
  std::vector<PictureName> names;
  for (const PictureSource& picture : pictures) {
    const fs::path& file = found.heads[picture.head].files[picture.file_index].name;
    const auto& tile = found.tile_of_polygon[static_cast<std::size_t>(picture.polygon)];
    const bool tiled = file.native().find(kTileWord) != std::string::npos;
    names.push_back({parts.size() > 1 ? parts.at(file) : "",
                     tiled ? tile_number(tile[0], tile[1]) : 0, found.kind});
  }
  return names;
}

}  // namespace crowdface
