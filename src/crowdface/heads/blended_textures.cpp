// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/head_textures.h"
#include "crowdface/heads/light_of_image.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestUnasked = 4096;

/// Where each picture of the layout is first worn.
struct FirstWorn {
  std::size_t head = 0;
  std::uint32_t row = 0;  ///< of its files
  Index face = 0;
};

/// Each face is painted where the first head that has a texture there has it.
std::vector<FirstWorn> lay_out(const HeadsTextures& found, TextureLayout& layout) {
  layout.tile = found.tile;
  layout.of_face.assign(found.tile.size(), kNoIndex);
  std::vector<FirstWorn> first;
  std::map<std::pair<std::size_t, std::uint32_t>, std::uint32_t> known;
  for (std::size_t f = 0; f < layout.of_face.size(); ++f) {
    for (std::size_t h = 0; h < found.heads.size(); ++h) {
      const std::uint32_t row = found.heads[h].of_face[f];
      if (row == kNoIndex) continue;
      const auto [picture, is_new] =
          known.emplace(std::pair(h, row), static_cast<std::uint32_t>(first.size()));
      if (is_new) first.push_back({h, row, static_cast<Index>(f)});
      layout.of_face[f] = picture->second;
      break;
    }
  }
  return first;
}

/// Letters and digits of a material's name: it becomes a part of files' names.
std::string part_name(const std::string& material) {
  std::string name;
  for (const char c : material) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain || c == '-' || c == '_') name += c;
  }
  return name.substr(0, 40);
}

std::vector<PictureName> picture_names(const HeadsTextures& found,
                                       const std::vector<FirstWorn>& pictures,
                                       const FaceMaterials& materials) {
  std::map<fs::path, std::string> parts;
  std::set<std::string> taken;
  for (const FirstWorn& picture : pictures) {
    const fs::path& file = found.heads[picture.head].files[picture.row].name;
    if (parts.contains(file)) continue;
    const auto face = static_cast<std::size_t>(picture.face);
    std::string part = part_name(materials.names[materials.of_face[face]]);
    if (part.empty() || taken.contains(part)) part += std::to_string(parts.size() + 1);
    taken.insert(part);
    parts.emplace(file, part);
  }
  std::vector<PictureName> names;
  for (const FirstWorn& picture : pictures) {
    const fs::path& file = found.heads[picture.head].files[picture.row].name;
    const auto& tile = found.tile[static_cast<std::size_t>(picture.face)];
    const bool tiled = file.native().find(kTileWord) != std::string::npos;
    names.push_back(
        {parts.size() > 1 ? parts.at(file) : "", tiled ? tile_number(tile[0], tile[1]) : 0});
  }
  return names;
}

/// The files that a head wears in each picture; none where a face of it goes without.
std::vector<std::vector<std::uint32_t>> rows_in_pictures(const WornTextures& worn,
                                                         const TextureLayout& layout,
                                                         std::size_t pictures) {
  std::vector<std::set<std::uint32_t>> rows(pictures);
  for (std::size_t f = 0; f < layout.of_face.size(); ++f) {
    if (layout.of_face[f] != kNoIndex) rows[layout.of_face[f]].insert(worn.of_face[f]);
  }
  std::vector<std::vector<std::uint32_t>> result;
  for (const auto& of_picture : rows) {
    if (of_picture.contains(kNoIndex)) {
      result.emplace_back();
    } else {
      result.emplace_back(of_picture.begin(), of_picture.end());
    }
  }
  return result;
}

/// A texture file as it is needed: at some size.
using NeededMap = std::tuple<fs::path, int, int>;
using LoadedMaps = std::map<NeededMap, std::shared_ptr<const TextureMap>>;

std::shared_ptr<const TextureMap> read_map(const fs::path& path, int width, int height) {
  struct Kept {
    ImageMemory memory;
    TextureMap map;
  };
  throw_if_interrupted();
  const std::uint64_t texels =
      static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  ImageMemory memory = take_image_memory(path, 3 * sizeof(Density) * texels);
  const Image image = read_image(path, {.jpeg = true});
  const auto kept = std::make_shared<const Kept>(
      Kept{std::move(memory), make_texture_map(width, height, light_of(image))});
  return {kept, &kept->map};
}

void read_maps(LoadedMaps& maps) {
  std::vector<LoadedMaps::value_type*> all;
  for (auto& map : maps) all.push_back(&map);
  parallel_for_each(all.size(), [&](std::size_t i) {
    const auto& [path, width, height] = all[i]->first;
    all[i]->second = read_map(path, width, height);
  });
}

/// One map of several, each of which covers some of the picture's faces.
std::shared_ptr<const TextureMap> compose(
    const FaceSet& faces, const TextureLayout& layout, std::uint32_t picture,
    const std::vector<std::uint32_t>& of_face,
    const std::map<std::uint32_t, std::shared_ptr<const TextureMap>>& maps) {
  auto composed = std::make_shared<TextureMap>(*maps.begin()->second);
  const SurfaceTexels texels(faces.topology, faces.uvs, layout, picture);
  for (int y = 0; y < texels.height(); ++y) {
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      const TextureMap& from = *maps.at(of_face[texels.triangle(span.triangle).face]);
      for (int c = 0; c < 3; ++c) {
        std::copy(from.row(c, y) + span.begin, from.row(c, y) + span.end,
                  composed->row(c, y) + span.begin);
      }
    }
  }
  return composed;
}

/// \param sizes  of all files. \param rows  #heads by #pictures, see rows_in_pictures.
void choose_sizes(const HeadsTextures& found, const std::map<fs::path, ImageSize>& sizes,
                  const std::vector<std::vector<std::vector<std::uint32_t>>>& rows,
                  std::optional<std::uint64_t> size, TextureLayout& layout) {
  for (std::size_t p = 0; p < layout.pictures.size(); ++p) {
    TextureLayout::Picture& picture = layout.pictures[p];
    for (std::size_t h = 0; h < rows.size(); ++h) {
      for (const std::uint32_t row : rows[h][p]) {
        const ImageSize& file = sizes.at(found.heads[h].files[row].path);
        picture.width = std::max(picture.width, file.width);
        picture.height = std::max(picture.height, file.height);
      }
    }
    const int longer = std::max(picture.width, picture.height);
    const int wanted = size ? static_cast<int>(*size) : std::min(longer, kLargestUnasked);
    const auto scaled = [&](int side) {
      return std::max(1, static_cast<int>(std::int64_t{side} * wanted / longer));
    };
    picture = {scaled(picture.width), scaled(picture.height)};
  }
}

}  // namespace

HeadTextures load_blended_textures(const FaceSet& faces, const FaceMaterials& materials,
                                   HeadsTextures found, std::optional<std::uint64_t> size) {
  HeadTextures result;
  TextureLayout& layout = result.blended.layout;
  const std::vector<FirstWorn> pictures = lay_out(found, layout);
  layout.pictures.resize(pictures.size());
  result.names = picture_names(found, pictures, materials);

  std::vector<std::vector<std::vector<std::uint32_t>>> rows;
  std::map<fs::path, ImageSize> sizes;
  std::map<fs::path, Digest> contents;
  Hasher hasher;
  for (const WornTextures& worn : found.heads) {
    rows.push_back(rows_in_pictures(worn, layout, pictures.size()));
    hasher.add(worn.files.size());
    for (const WornTextures::File& file : worn.files) {
      if (!sizes.contains(file.path)) {
        sizes[file.path] = read_image_size(file.path, {.jpeg = true});
        contents[file.path] = hash_file(file.path).digest;
      }
      hasher.add(contents[file.path]);
    }
    hasher.add_array(std::span<const std::uint32_t>(worn.of_face));
  }
  choose_sizes(found, sizes, rows, size, layout);

  const auto needed = [&](std::size_t h, std::uint32_t row, std::size_t p) {
    return NeededMap(found.heads[h].files[row].path, layout.pictures[p].width,
                     layout.pictures[p].height);
  };
  LoadedMaps maps;
  for (std::size_t h = 0; h < rows.size(); ++h) {
    for (std::size_t p = 0; p < pictures.size(); ++p) {
      for (const std::uint32_t row : rows[h][p]) maps[needed(h, row, p)];
    }
  }
  read_maps(maps);

  result.blended.maps.resize(pictures.size());
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    hasher.add(layout.pictures[p].width).add(layout.pictures[p].height);
    for (std::size_t h = 0; h < rows.size(); ++h) {
      auto& map = result.blended.maps[p].emplace_back();
      std::map<std::uint32_t, std::shared_ptr<const TextureMap>> of_row;
      for (const std::uint32_t row : rows[h][p]) of_row[row] = maps.at(needed(h, row, p));
      if (of_row.size() == 1) map = of_row.begin()->second;
      if (of_row.size() > 1) {
        map = compose(faces, layout, static_cast<std::uint32_t>(p), found.heads[h].of_face, of_row);
      }
      if (map) continue;
      const PictureName& name = result.names[p];
      found.warnings.push_back(
          concat(faces.heads[h].name, ": has no colour texture",
                 name.part.empty() ? "" : concat(" for all of ", name.part),
                 name.tile == 0 ? "" : concat(" in tile ", name.tile),
                 "; where faces would have its colours they have those of their other heads"));
    }
  }
  result.warnings = std::move(found.warnings);
  result.digest = hasher.digest();
  return result;
}

}  // namespace crowdface
