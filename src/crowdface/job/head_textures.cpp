// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/head_textures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/tile_files.h"
#include "crowdface/region/uv_samples.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

Texture to_texture(const Image& image) {
  std::vector<float> linear(65536);
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const float value = static_cast<float>(i) / 65535.0F;
    linear[i] = from_srgb(Eigen::Array3f::Constant(value))[0];
  }
  const bool grey = image.channels < 3;
  Texture texture{image.width, image.height, {}};
  texture.texels.reserve(static_cast<std::size_t>(image.width) *
                         static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      Light light;
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y, grey ? 0 : c);
        light[c] = image.of_floats
                       ? std::max(value, 0.0F)
                       : linear[static_cast<std::size_t>(std::lround(65535.0F * value))];
      }
      texture.texels.push_back(light);
    }
  }
  return texture;
}

/// Texture files, each read once however many heads name it.
class TextureShelf {
 public:
  explicit TextureShelf(int most_px) : most_px_(most_px) {}

  /// Nothing if there is no such file.
  std::shared_ptr<const Texture> get(const fs::path& path) {
    const auto known = textures_.find(path);
    if (known != textures_.end()) return known->second;
    std::shared_ptr<const Texture> texture;
    if (fs::is_regular_file(path)) {
      const Image image = read_image(path, {.jpeg = true});
      texture = std::make_shared<const Texture>(shrunk(to_texture(image), most_px_));
      hasher_.add(path.filename().string()).add(hash_file(path).digest);
    }
    textures_.emplace(path, texture);
    return texture;
  }
  Digest digest() const { return hasher_.digest(); }

 private:
  int most_px_;
  std::map<fs::path, std::shared_ptr<const Texture>> textures_;
  Hasher hasher_;
};

/// The number of the UDIM tile that a face lies in, told by its middle, so that corners on a border
/// do no harm. 1001 for a face without coordinates or outside all tiles.
int tile_of(const FaceSet& faces, Index face) {
  const Topology& topology = faces.topology;
  Eigen::RowVector2d sum(0, 0);
  double corners = 0;
  const auto f = static_cast<std::size_t>(face);
  for (auto c = topology.face_offsets[f]; c < topology.face_offsets[f + 1]; ++c) {
    if (topology.corner_uvs[c] == kNoIndex) return 1001;
    sum += faces.uvs.row(topology.corner_uvs[c]);
    corners += 1;
  }
  const Eigen::RowVector2d middle = sum / corners;
  if (!(middle.minCoeff() >= 0 && middle.x() < 10 && middle.y() < 900)) return 1001;
  return tile_number(std::floor(middle.x()), std::floor(middle.y()));
}

}  // namespace

HeadTextures load_textures(const FaceSet& faces, std::span<const ObjFile> files, int most_px) {
  HeadTextures result;
  TextureShelf shelf(most_px);
  bool any = false;
  const auto face_count = static_cast<std::size_t>(faces.topology.face_count());
  std::vector<int> tiles(face_count, 1001);
  if (!faces.topology.corner_uvs.empty()) {
    for (std::size_t f = 0; f < face_count; ++f) tiles[f] = tile_of(faces, static_cast<Index>(f));
  }
  for (const ObjFile& file : files) {
    const ColourTextures named = find_colour_textures(file.path, file.material_libraries);
    for (const std::string& text : named.warnings) result.warnings.push_back(text);
    const std::vector<std::string> materials =
        face_materials(file.materials, faces.topology.face_count());
    TextureCoat coat;
    coat.of_face.assign(face_count, TextureCoat::kNone);
    std::map<fs::path, std::uint32_t> rows;
    for (std::size_t f = 0; f < face_count && !faces.topology.corner_uvs.empty(); ++f) {
      const auto found = named.of_material.find(materials[f]);
      if (found == named.of_material.end()) continue;
      const fs::path path = with_tile(found->second, tiles[f]);
      auto row = rows.find(path);
      if (row == rows.end()) {
        const auto texture = shelf.get(path);
        row = rows.emplace(path, texture ? static_cast<std::uint32_t>(coat.textures.size())
                                         : TextureCoat::kNone)
                  .first;
        if (texture) {
          coat.textures.push_back(texture);
        } else {
          result.warnings.push_back(concat(file.path.string(), ": the texture ",
                                           quoted(path.string()),
                                           " is missing; pictures show the surface without"));
        }
      }
      coat.of_face[f] = row->second;
    }
    any = any || !coat.textures.empty();
    result.coats.push_back(std::move(coat));
  }
  if (!any) {
    throw MissingInput(concat(files.front().path.string(),
                              ": output.contact_sheet.texture asks for textures, and no head's "
                              "materials name one that is there (map_Kd in the file of mtllib, and "
                              "texture coordinates)"));
  }
  result.digest = shelf.digest();
  return result;
}

}  // namespace crowdface
