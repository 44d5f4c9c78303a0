// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_texture_files.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

using TilePlace = std::array<std::int32_t, 2>;

/// Returns a warning if some materials name textures, but no polygon uses any of these materials.
/// The textures are then not shown.
std::optional<std::string> unused_materials_warning(const NamedTextures& named, const ObjFile& file,
                                                    Index face_count) {
  const auto colours = named.paths_by_kind.find(TextureKind::kColour);
  if (colours == named.paths_by_kind.end()) return std::nullopt;
  std::vector<std::string> textured, used;
  for (const auto& [material, path] : colours->second) {
    if (!material.empty()) textured.push_back(quoted(material));
  }
  for (const std::string& material : polygon_materials(file.materials, face_count).names) {
    if (colours->second.contains(material)) return std::nullopt;
    if (!material.empty()) used.push_back(quoted(material));
  }
  const std::string not_shown = "the textures of its material files are not shown: ";
  if (textured.empty()) return concat(not_shown, "no statement newmtl stands before them");
  return concat(not_shown, "no polygon uses their materials ", join(textured),
                used.empty() ? " (usemtl)" : "; its materials are ", join(used));
}

/// Returns the UDIM tile of a polygon. The polygon's centroid determines the tile, so that corners
/// may lie on a tile's border. Returns the first tile if the polygon has no texture coordinates or
/// lies outside all tiles.
TilePlace tile_of(const HeadSet& heads, Index face) {
  Eigen::RowVector2d sum(0, 0);
  double corners = 0;
  for (const std::uint32_t uv : heads.topology.face_uvs(face)) {
    if (uv == kNoIndex) return {0, 0};
    sum += heads.uvs.row(uv);
    corners += 1;
  }
  const Eigen::RowVector2d middle = sum / corners;
  if (!(middle.minCoeff() >= 0 && middle.x() < 10 && middle.y() < 900)) return {0, 0};
  return {static_cast<std::int32_t>(middle.x()), static_cast<std::int32_t>(middle.y())};
}

/// Finds the texture file of each polygon of a head, for one kind of texture.
/// \param of_material  for each material, its texture file
/// \param ranges       materials of the polygons
/// \param missing      receives the UDIM tiles that do not exist
HeadTextureFiles texture_files_of(const std::map<std::string, fs::path>& of_material,
                                  const std::vector<TilePlace>& tiles,
                                  const std::vector<MaterialRange>& ranges,
                                  std::vector<fs::path>& missing) {
  HeadTextureFiles placed;
  if (of_material.empty()) return placed;
  placed.file_of_polygon.assign(tiles.size(), kNoIndex);
  const PolygonMaterials materials = polygon_materials(ranges, static_cast<Index>(tiles.size()));
  std::map<fs::path, std::uint32_t> rows;
  for (std::size_t f = 0; f < tiles.size(); ++f) {
    throw_if_interrupted();
    const std::uint32_t material = materials.material_of_polygon[f];
    if (f > 0 && material == materials.material_of_polygon[f - 1] && tiles[f] == tiles[f - 1]) {
      placed.file_of_polygon[f] = placed.file_of_polygon[f - 1];
      continue;
    }
    const auto found = of_material.find(materials.names[material]);
    if (found == of_material.end()) continue;
    const fs::path path = udim_tile_path(found->second, tile_number(tiles[f][0], tiles[f][1]));
    const auto [row, is_new] = rows.emplace(path, kNoIndex);
    if (is_new && is_file(path)) {
      row->second = static_cast<std::uint32_t>(placed.files.size());
      placed.files.push_back({path, found->second});
    } else if (is_new && !find_tiles(found->second).empty()) {
      // Report a missing UDIM tile. The reader of the material file has already reported all other
      // missing files.
      missing.push_back(path);
    }
    placed.file_of_polygon[f] = row->second;
  }
  return placed;
}

}  // namespace

bool FoundTextureFiles::has_files() const {
  return std::ranges::any_of(heads,
                             [](const HeadTextureFiles& placed) { return !placed.files.empty(); });
}

bool FoundTextureFiles::heads_have_different_textures() const {
  const auto paths_of = [](const HeadTextureFiles& placed) {
    std::vector<fs::path> paths;
    for (const HeadTextureFiles::File& file : placed.files) paths.push_back(file.path);
    return paths;
  };
  const HeadTextureFiles* first = nullptr;
  for (const HeadTextureFiles& placed : heads) {
    if (placed.files.empty()) continue;
    if (first == nullptr) first = &placed;
    if (paths_of(placed) != paths_of(*first)) return true;
  }
  return false;
}

void leave_out_files(FoundTextureFiles& textures, const std::set<fs::path>& files) {
  for (HeadTextureFiles& placed : textures.heads) {
    std::vector<std::uint32_t> row(placed.files.size(), kNoIndex);
    std::vector<HeadTextureFiles::File> kept;
    for (std::size_t i = 0; i < placed.files.size(); ++i) {
      if (files.contains(placed.files[i].path)) continue;
      row[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(placed.files[i]);
    }
    placed.files = std::move(kept);
    for (std::uint32_t& file : placed.file_of_polygon) {
      if (file != kNoIndex) file = row[file];
    }
  }
}

std::vector<std::string> leave_out_unreadable_files(FoundTextureFiles& textures) {
  std::vector<std::string> warnings;
  std::set<fs::path> seen, unreadable;
  for (const HeadTextureFiles& placed : textures.heads) {
    for (const HeadTextureFiles::File& file : placed.files) {
      if (!seen.insert(file.path).second) continue;
      try {
        read_image_size(file.path, {.allows_jpeg = true});
      } catch (const InvalidInput& error) {
        unreadable.insert(file.path);
        warnings.push_back(concat(error.what(), "; the texture is neither blended nor shown"));
      }
    }
  }
  leave_out_files(textures, unreadable);
  return warnings;
}

std::vector<FoundTextureFiles> find_texture_files(const HeadSet& heads,
                                                  std::span<const ObjFile> files) {
  const Index face_count = heads.topology.face_count();
  const bool has_uvs = !heads.topology.corner_uvs.empty();
  std::vector<TilePlace> tile(static_cast<std::size_t>(face_count), TilePlace{0, 0});
  if (has_uvs) {
    constexpr Index kBlock = 16384;
    parallel_for_each(face_count, kBlock,
                      [&](Index f) { tile[static_cast<std::size_t>(f)] = tile_of(heads, f); });
  }
  // If several heads share a material file, read this file only once.
  std::map<std::pair<fs::path, std::vector<std::string>>, NamedTextures> known;
  std::vector<const NamedTextures*> of_head;
  std::set<TextureKind> kinds = {TextureKind::kColour};
  for (const ObjFile& file : files) {
    const auto [entry, is_new] =
        known.try_emplace({file.material_path().parent_path(), file.material_libraries});
    NamedTextures& named = entry->second;
    if (is_new) {
      named = find_textures(file.material_path(), file.material_libraries);
      if (!has_uvs) named.paths_by_kind.clear();
    }
    for (const auto& [kind, of_material] : named.paths_by_kind) kinds.insert(kind);
    of_head.push_back(&named);
  }
  std::vector<FoundTextureFiles> all;
  for (const TextureKind kind : kinds) {
    FoundTextureFiles result{kind, {}, tile, {}};
    std::map<std::string, std::vector<std::string>> heads_of_warning;
    for (std::size_t h = 0; h < files.size(); ++h) {
      const std::string head =
          h < heads.heads.size() ? heads.heads[h].name : files[h].path.stem().string();
      if (kind == TextureKind::kColour) {
        for (const std::string& text : of_head[h]->warnings) heads_of_warning[text].push_back(head);
        const auto unused = unused_materials_warning(*of_head[h], files[h], face_count);
        if (unused) heads_of_warning[*unused].push_back(head);
      }
      std::vector<fs::path> missing;
      const auto named = of_head[h]->paths_by_kind.find(kind);
      result.heads.push_back(texture_files_of(named == of_head[h]->paths_by_kind.end()
                                                  ? std::map<std::string, fs::path>()
                                                  : named->second,
                                              tile, files[h].materials, missing));
      for (const fs::path& path : missing) {
        heads_of_warning[concat("texture ", quoted(path.string()), " is missing; renders omit it")]
            .push_back(head);
      }
    }
    for (const auto& [text, names] : heads_of_warning) {
      result.warnings.push_back(concat(text, " (", join(names), ")"));
    }
    if (result.has_files()) {
      for (HeadTextureFiles& placed : result.heads)
        placed.file_of_polygon.resize(tile.size(), kNoIndex);
    }
    if (kind == TextureKind::kColour || result.has_files()) all.push_back(std::move(result));
  }
  return all;
}

}  // namespace crowdface
