// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_textures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <system_error>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

Texture to_texture(const Image& image, int most_px) {
  std::vector<float> linear(65536);
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const float value = static_cast<float>(i) / 65535.0F;
    linear[i] = from_srgb(Eigen::Array3f::Constant(value))[0];
  }
  const bool grey = image.channels < 3;
  return shrunk_texture(image.width, image.height, most_px, [&](int y, std::span<Light> texels) {
    for (int x = 0; x < image.width; ++x) {
      Light& light = texels[static_cast<std::size_t>(x)];
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y, grey ? 0 : c);
        light[c] = image.of_floats()
                       ? std::max(value, 0.0F)
                       : linear[static_cast<std::size_t>(std::lround(65535.0F * value))];
      }
    }
  });
}

/// The texture, and its share of all images' memory for as long as it lives.
std::shared_ptr<const Texture> read_texture(const fs::path& path, int most_px) {
  struct Kept {
    ImageMemory memory;
    Texture texture;
  };
  const Image image = read_image(path, {.jpeg = true});
  const auto texels = static_cast<std::uint64_t>(std::min(image.width, most_px)) *
                      static_cast<std::uint64_t>(std::min(image.height, most_px));
  ImageMemory memory = take_image_memory(path, texels * sizeof(Light));
  const auto kept =
      std::make_shared<const Kept>(Kept{std::move(memory), to_texture(image, most_px)});
  return {kept, &kept->texture};
}

/// A texture and the digest of its file.
struct TextureFile {
  std::shared_ptr<const Texture> texture;  ///< nothing if there is no such file
  Digest content;
};

/// Texture files, each read once however many heads name it.
class TextureShelf {
 public:
  explicit TextureShelf(int most_px) : most_px_(most_px) {}

  const TextureFile& get(const fs::path& path) {
    const auto known = files_.find(path);
    if (known != files_.end()) return known->second;
    throw_if_interrupted();
    TextureFile file;
    std::error_code ignored;  // a name longer than the system allows is that of no file
    if (fs::is_regular_file(path, ignored)) {
      file.texture = read_texture(path, most_px_);
      file.content = hash_file(path).digest;
    }
    return files_.emplace(path, std::move(file)).first->second;
  }

 private:
  int most_px_;
  std::map<fs::path, TextureFile> files_;
};

/// The number of the UDIM tile that a face lies in, told by its middle, so that corners on a border
/// do no harm. The first for a face without coordinates or outside all tiles.
int tile_of(const FaceSet& faces, Index face) {
  const Topology& topology = faces.topology;
  Eigen::RowVector2d sum(0, 0);
  double corners = 0;
  const auto f = static_cast<std::size_t>(face);
  for (auto c = topology.face_offsets[f]; c < topology.face_offsets[f + 1]; ++c) {
    if (topology.corner_uvs[c] == kNoIndex) return kFirstTile;
    sum += faces.uvs.row(topology.corner_uvs[c]);
    corners += 1;
  }
  const Eigen::RowVector2d middle = sum / corners;
  if (!(middle.minCoeff() >= 0 && middle.x() < 10 && middle.y() < 900)) return kFirstTile;
  return tile_number(std::floor(middle.x()), std::floor(middle.y()));
}

std::vector<int> tiles_of(const FaceSet& faces) {
  std::vector<int> tiles(static_cast<std::size_t>(faces.topology.face_count()), kFirstTile);
  if (faces.topology.corner_uvs.empty()) return tiles;
  for (std::size_t f = 0; f < tiles.size(); ++f) tiles[f] = tile_of(faces, static_cast<Index>(f));
  return tiles;
}

/// What one head's faces wear.
struct NamedCoat {
  TextureCoat coat;
  std::vector<Digest> contents;  ///< #textures
  std::vector<fs::path> missing;
};

/// \param tiles  #faces.
NamedCoat coat_of(const ColourTextures& named, const std::vector<int>& tiles,
                  const FaceMaterials& materials, TextureShelf& shelf) {
  NamedCoat result;
  result.coat.of_face.assign(tiles.size(), TextureCoat::kNone);
  std::map<fs::path, std::uint32_t> rows;
  for (std::size_t f = 0; f < tiles.size(); ++f) {
    throw_if_interrupted();
    const auto found = named.of_material.find(materials.names[materials.of_face[f]]);
    if (found == named.of_material.end()) continue;
    const fs::path path = with_tile(found->second, tiles[f]);
    const auto [row, is_new] = rows.emplace(path, TextureCoat::kNone);
    if (is_new) {
      const TextureFile& file = shelf.get(path);
      if (file.texture) {
        row->second = static_cast<std::uint32_t>(result.coat.textures.size());
        result.coat.textures.push_back(file.texture);
        result.contents.push_back(file.content);
      } else {
        result.missing.push_back(path);
      }
    }
    result.coat.of_face[f] = row->second;
  }
  return result;
}

/// Which face wears what, whatever the files are called.
void add_coat(const NamedCoat& named, Hasher& hasher) {
  hasher.add(named.contents.size());
  for (const Digest& content : named.contents) hasher.add(content);
  hasher.add_array(std::span<const std::uint32_t>(named.coat.of_face));
}

}  // namespace

HeadTextures load_textures(const FaceSet& faces, std::span<const ObjFile> files, int most_px) {
  HeadTextures result;
  Hasher hasher;
  TextureShelf shelf(most_px);
  // Heads of one folder mostly share their material files.
  std::map<std::pair<fs::path, std::vector<std::string>>, ColourTextures> known;
  bool any = false;
  const std::vector<int> tiles = tiles_of(faces);
  const bool has_uvs = !faces.topology.corner_uvs.empty();
  for (const ObjFile& file : files) {
    const auto [entry, is_new] =
        known.try_emplace({file.path.parent_path(), file.material_libraries});
    ColourTextures& named = entry->second;
    if (is_new) {
      named = find_colour_textures(file.path, file.material_libraries);
      for (const std::string& text : named.warnings) result.warnings.push_back(text);
      if (!has_uvs) named.of_material.clear();
    }
    NamedCoat wears =
        coat_of(named, tiles, face_materials(file.materials, faces.topology.face_count()), shelf);
    for (const fs::path& path : wears.missing) {
      result.warnings.push_back(concat(file.path.string(), ": the texture ", quoted(path.string()),
                                       " is missing; pictures show the surface without"));
    }
    any = any || !wears.coat.textures.empty();
    add_coat(wears, hasher);
    result.coats.push_back(std::move(wears.coat));
  }
  if (!any) {
    throw MissingInput(concat(files.front().path.string(),
                              ": output.contact_sheet.texture asks for textures, and no head's "
                              "materials name one that is there (map_Kd in the file of mtllib, and "
                              "texture coordinates)"));
  }
  result.digest = hasher.digest();
  return result;
}

}  // namespace crowdface
