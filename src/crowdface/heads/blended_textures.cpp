// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cached.h"
#include "crowdface/heads/head_textures.h"
#include "crowdface/heads/image_values.h"
#include "crowdface/heads/picture_layout.h"
#include "crowdface/io/image.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Largest side length of images, in texels, if the config gives no size.
constexpr int kMaxDefaultSide = 4096;

/// For each image of the layout, the texture files of one head that are merged into this image, as
/// indices into placed.files; no indices if some polygon of the image has no texture on the head.
std::vector<std::vector<std::uint32_t>> rows_in_pictures(const HeadTextureFiles& placed,
                                                         const TextureLayout& layout,
                                                         std::size_t pictures) {
  std::vector<std::set<std::uint32_t>> rows(pictures);
  for (std::size_t f = 0; f < layout.picture_of_polygon.size(); ++f) {
    if (layout.picture_of_polygon[f] != kNoIndex)
      rows[layout.picture_of_polygon[f]].insert(placed.file_of_polygon[f]);
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

/// A texture file, and the properties of the map to which the file is converted: size, content
/// (colours, normals or other values) and number of channels.
struct NeededMap {
  fs::path path = {};
  int width = 0, height = 0;
  MapContent content = MapContent::kColours;
  int channels = 3;
  Digest file_digest = {};  ///< hash of the texture file's bytes
  auto key() const { return std::tie(path, width, height, content, channels); }
  bool operator<(const NeededMap& other) const { return key() < other.key(); }
  Digest digest() const {
    return Hasher()
        .add(kTextureVersion)
        .add(file_digest)
        .add(width)
        .add(height)
        .add(static_cast<int>(content))
        .add(channels)
        .digest();
  }
};
using LoadedMaps = std::map<NeededMap, std::shared_ptr<const TextureMap>>;

/// Whether an image holds normals: normals point out of the surface, so their third channel is
/// large.
bool holds_normals(const Image& image) {
  if (image.channels < 3) return false;
  constexpr int kStep = 7;
  constexpr double kMinExcess = 0.15;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  double count = 0;
  for (int y = 0; y < image.height; y += kStep) {
    for (int x = 0; x < image.width; x += kStep) {
      for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(image.at(x, y, c));
      count += 1;
    }
  }
  return sum[2] - (sum[0] + sum[1]) / 2 > kMinExcess * count;
}

MapCoding coding_of_values(const Image& image, int channels) {
  const auto* floats = std::get_if<std::vector<float>>(&image.pixels);
  if (floats == nullptr) return MapCoding::value_coding(channels);
  const auto [low, high] = std::ranges::minmax_element(*floats);
  return MapCoding::value_coding(channels, *low, *high);
}

TextureMap map_of(const Image& image, const NeededMap& needed) {
  switch (needed.content) {
    case MapContent::kColours:
      return make_texture_map(needed.width, needed.height, linear_light_of(image));
    case MapContent::kSlopes:
      if (!holds_normals(image)) {
        throw InvalidInput(
            concat(needed.path.string(),
                   ": expected a normal map, in which blue is the brightest channel, found another "
                   "image; if this is a height map, name it with bump instead of norm"));
      }
      return make_texture_map(needed.width, needed.height, normal_slopes_of(image),
                              MapCoding::slope_coding());
    case MapContent::kValues:
      return make_texture_map(needed.width, needed.height, channel_values_of(image),
                              coding_of_values(image, needed.channels));
  }
  throw BrokenPrecondition("map_of: an unknown content");
}

std::uint64_t map_bytes(const NeededMap& needed) {
  return sizeof(StoredValue) * static_cast<std::uint64_t>(needed.width) *
         static_cast<std::uint64_t>(needed.height) * static_cast<std::uint64_t>(needed.channels);
}

/// A map as a cache entry stores it.
struct StoredMap {
  float low = 0, step = 1;
  std::span<const StoredValue> planes;
};

constexpr auto kMapArrays = [](auto& arrays, auto& map) {
  arrays("low", map.low);
  arrays("step", map.step);
  arrays("planes", map.planes);
};

/// Keeps converted maps in the cache. The kernel can drop and reload the pages of these files, so
/// the maps do not count as memory of this process.
class MapCache {
 public:
  explicit MapCache(const CacheFolder& cache) : cache_(cache), works_(!cache.path.empty()) {}

  /// Finds a map in the cache; null if the cache does not have the map.
  /// \param blank  a map of the right size and kind, into which the values are read
  std::shared_ptr<const TextureMap> find(const Digest& key, TextureMap blank) const {
    const auto is_sound = [&](const StoredMap& stored, const CacheEntry& entry) {
      blank.mapped_file = entry.file();
      const auto channels = static_cast<std::size_t>(blank.coding.channels);
      return stored.planes.size() == channels * blank.texel_count() && stored.step > 0;
    };
    const auto stored = find_cached<StoredMap>(cache_, {"map", key}, kMapArrays, is_sound);
    if (!stored) return nullptr;
    blank.coding.low = stored->low;
    blank.coding.step = stored->step;
    blank.mapped_planes = stored->planes;
    return std::make_shared<const TextureMap>(std::move(blank));
  }

  /// Stores a map. \return the stored map; null if it cannot be stored
  std::shared_ptr<const TextureMap> store(const Digest& key, const TextureMap& map) {
    const StoredMap stored{map.coding.low, map.coding.step, map.stored()};
    works_ = works_ && crowdface::store(cache_, {"map", key}, arrays_of(stored, kMapArrays),
                                        "converted textures");
    return works_ ? find(key, {map.width, map.height, {}, map.coding}) : nullptr;
  }

 private:
  const CacheFolder& cache_;
  /// whether converted maps can be stored: there is a cache, and no write has failed yet
  std::atomic<bool> works_;
};

std::shared_ptr<const TextureMap> read_map(const NeededMap& needed, MapCache& cache) {
  struct Kept {
    ImageMemory memory;
    TextureMap map;
  };
  throw_if_interrupted();
  const Digest key = needed.digest();
  if (auto found =
          cache.find(key, {needed.width, needed.height, {}, {needed.content, needed.channels}})) {
    return found;
  }
  Kept read{reserve_image_memory(needed.path, map_bytes(needed)),
            map_of(read_image(needed.path, {.allows_jpeg = true}), needed)};
  if (auto stored = cache.store(key, read.map)) return stored;
  const auto kept = std::make_shared<const Kept>(std::move(read));
  return {kept, &kept->map};
}

void read_maps(LoadedMaps& maps, MapCache& cache) {
  std::vector<LoadedMaps::value_type*> all;
  for (auto& map : maps) all.push_back(&map);
  parallel_for_each(all.size(),
                    [&](std::size_t i) { all[i]->second = read_map(all[i]->first, cache); });
}

/// Merges several maps, each of which covers some of the polygons that use the image.
std::shared_ptr<const TextureMap> compose(
    const HeadSet& heads, const TextureLayout& layout, std::uint32_t picture,
    const std::vector<std::uint32_t>& file_of_polygon,
    const std::map<std::uint32_t, std::shared_ptr<const TextureMap>>& maps, const Digest& key,
    MapCache& cache) {
  const TextureMap& first = *maps.begin()->second;
  if (auto found = cache.find(key, {first.width, first.height, {}, first.coding})) return found;
  const std::span<const StoredValue> stored = first.stored();
  auto composed = std::make_shared<TextureMap>(
      TextureMap{first.width, first.height, {stored.begin(), stored.end()}, first.coding});
  MapCoding& coding = composed->coding;
  if (coding.content == MapContent::kValues) {
    float high = coding.low;
    for (const auto& [row, map] : maps) {
      coding.low = std::min(coding.low, map->coding.low);
      high = std::max(high, map->decode(65535));
    }
    coding = MapCoding::value_coding(coding.channels, coding.low, high);
  }
  const SurfaceTexels texels(heads.topology, heads.uvs, layout, picture);
  for (int y = 0; y < texels.height(); ++y) {
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      const TextureMap& from = *maps.at(file_of_polygon[texels.triangle(span.triangle).face]);
      for (int c = 0; c < coding.channels; ++c) {
        std::transform(from.row(c, y) + span.begin, from.row(c, y) + span.end,
                       composed->row(c, y) + span.begin,
                       [&](StoredValue number) { return coding.encode(from.decode(number)); });
      }
    }
  }
  if (auto kept = cache.store(key, *composed)) return kept;
  return composed;
}

/// Sets the size of each image of the blended textures.
/// \param sizes   size of each texture file
/// \param rows    rows[h][p]: which files of head h (indices into found.heads[h].files) image p of
///                the layout shows, see rows_in_pictures
/// \param size    largest side of an image in pixels; empty: the side of the largest file, at most
///                kMaxDefaultSide
/// \param layout  the images of the blended textures; the function sets their sizes
void choose_sizes(const FoundTextureFiles& found, const std::map<fs::path, ImageSize>& sizes,
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
    const int wanted = size ? static_cast<int>(*size) : std::min(longer, kMaxDefaultSide);
    const auto scaled = [&](int side) {
      return std::max(1, static_cast<int>(std::int64_t{side} * wanted / longer));
    };
    picture = {scaled(picture.width), scaled(picture.height)};
  }
}

/// The content and the number of channels that the maps of all heads for one image of a blended
/// texture get.
/// \param first     the first texture file that is drawn into the image; tells normal maps from
///                  height maps in bump textures
/// \param channels  largest number of channels of the texture files that are drawn into the image
NeededMap content_of(TextureKind kind, const fs::path& first, int channels) {
  switch (kind) {
    case TextureKind::kColour:
      return {.content = MapContent::kColours, .channels = 3};
    case TextureKind::kNormal:
      return {.content = MapContent::kSlopes, .channels = 2};
    case TextureKind::kBump:
      if (channels >= 3 && holds_normals(read_image(first, {.allows_jpeg = true}))) {
        return {.content = MapContent::kSlopes, .channels = 2};
      }
      return {.content = MapContent::kValues, .channels = 1};
    case TextureKind::kSpecular:
      return {.content = MapContent::kValues, .channels = channels >= 3 ? 3 : 1};
    case TextureKind::kRoughness:
    case TextureKind::kDisplacement:
      return {.content = MapContent::kValues, .channels = 1};
  }
  throw BrokenPrecondition("content_of: an unknown kind of texture");
}

}  // namespace

HeadTextures load_blended_textures(const HeadSet& heads, const PolygonMaterials& materials,
                                   FoundTextureFiles found, std::optional<std::uint64_t> size,
                                   const CacheFolder& cache) {
  HeadTextures result;
  TextureLayout& layout = result.blended.layout;
  const std::vector<PictureSource> pictures = lay_out_pictures(found, layout);
  result.names = picture_names(found, pictures, materials);

  std::vector<std::vector<std::vector<std::uint32_t>>> rows;
  std::map<fs::path, ImageSize> sizes;
  std::map<fs::path, Digest> contents;
  Hasher hasher;
  for (const HeadTextureFiles& placed : found.heads) {
    rows.push_back(rows_in_pictures(placed, layout, pictures.size()));
    hasher.add(placed.files.size());
    for (const HeadTextureFiles::File& file : placed.files) {
      if (!sizes.contains(file.path)) {
        sizes[file.path] = read_image_size(file.path, {.allows_jpeg = true});
        contents[file.path] = hash_file(file.path).digest;
      }
      hasher.add(contents[file.path]);
    }
    hasher.add_array(std::span<const std::uint32_t>(placed.file_of_polygon));
  }
  choose_sizes(found, sizes, rows, size, layout);

  std::vector<NeededMap> held;
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    PictureName& name = result.names[p];
    int channels = 0;
    for (std::size_t h = 0; h < rows.size(); ++h) {
      for (const std::uint32_t row : rows[h][p]) {
        const ImageSize& file = sizes.at(found.heads[h].files[row].path);
        channels = std::max(channels, file.channels);
        name.all_files_have_8_bit_values =
            name.all_files_have_8_bit_values && file.has_8_bit_values;
        name.some_file_has_floats = name.some_file_has_floats || file.has_floats;
      }
    }
    const auto& first = found.heads[pictures[p].head].files[pictures[p].file_index].path;
    held.push_back(content_of(found.kind, first, channels));
  }
  const auto needed = [&](std::size_t h, std::uint32_t row, std::size_t p) {
    NeededMap map = held[p];
    map.path = found.heads[h].files[row].path;
    map.file_digest = contents.at(map.path);
    map.width = layout.pictures[p].width;
    map.height = layout.pictures[p].height;
    return map;
  };
  LoadedMaps maps;
  for (std::size_t h = 0; h < rows.size(); ++h) {
    for (std::size_t p = 0; p < pictures.size(); ++p) {
      for (const std::uint32_t row : rows[h][p]) maps[needed(h, row, p)];
    }
  }
  MapCache kept_maps(cache);
  read_maps(maps, kept_maps);

  result.blended.maps.resize(pictures.size());
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    hasher.add(layout.pictures[p].width).add(layout.pictures[p].height);
    for (std::size_t h = 0; h < rows.size(); ++h) {
      auto& map = result.blended.maps[p].emplace_back();
      std::map<std::uint32_t, std::shared_ptr<const TextureMap>> of_row;
      Hasher composed;  // of everything that a composed map depends on
      for (const std::uint32_t row : rows[h][p]) {
        const NeededMap source = needed(h, row, p);
        of_row[row] = maps.at(source);
        composed.add(row).add(source.digest());
      }
      if (of_row.size() == 1) map = of_row.begin()->second;
      if (of_row.size() > 1) {
        composed.add(p).add_array(std::span<const std::uint32_t>(found.heads[h].file_of_polygon));
        composed.add_array(std::span<const std::uint32_t>(layout.picture_of_polygon));
        for (const auto& tile : layout.tile_of_polygon) composed.add(tile[0]).add(tile[1]);
        composed.add_array(std::span<const std::uint32_t>(heads.topology.corner_uvs));
        composed.add_array(std::span(heads.uvs.data(), static_cast<std::size_t>(heads.uvs.size())));
        map = compose(heads, layout, static_cast<std::uint32_t>(p), found.heads[h].file_of_polygon,
                      of_row, composed.digest(), kept_maps);
      }
      if (map) continue;
      const PictureName& name = result.names[p];
      found.warnings.push_back(
          concat(heads.heads[h].name, ": has no ", mtl_statement_of(found.kind).name, " texture",
                 name.material.empty() ? "" : concat(" for all of ", name.material),
                 name.tile == 0 ? "" : concat(" in tile ", name.tile),
                 "; in its place, faces use the textures of their other heads"));
    }
  }
  result.warnings = std::move(found.warnings);
  result.digest = hasher.digest();
  return result;
}

}  // namespace crowdface
