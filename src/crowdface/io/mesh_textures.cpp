// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/mesh_textures.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image_container.h"
#include "crowdface/io/texture_search.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

/// The file extension for an image. The image's first bytes determine the extension, as they
/// determine the format when the image is read.
std::string_view image_ending(std::string_view bytes) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kEndings = {{{"png", ".png"},
                                                                        {"jpeg", ".jpg"},
                                                                        {"openexr", ".exr"},
                                                                        {"bmp", ".bmp"},
                                                                        {"psd", ".psd"},
                                                                        {"gif", ".gif"},
                                                                        {"webp", ".webp"},
                                                                        {"targa", ".tga"}}};
  const std::string format = image_format(bytes);
  for (const auto& [name, ending] : kEndings) {
    if (name == format) return ending;
  }
  return bytes.starts_with("\xabKTX 20\xbb") ? ".ktx2" : ".tif";
}

}  // namespace

std::string material_name_of(std::string name) {
  constexpr std::size_t kLongest = 200;
  name.resize(std::min(name.size(), kLongest));
  std::ranges::replace_if(
      name, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '_');
  return name.empty() ? "material" : name;
}

void read_texture_files(std::vector<std::string> files, const std::filesystem::path& path,
                        FileMesh& mesh) {
  for (std::size_t t = mesh.textures.size(); t-- > 0;) {
    if (files[t].empty()) continue;
    std::ranges::replace(files[t], '\\', '/');
    const std::filesystem::path named = files[t], folder = path.parent_path();
    const bool is_tiled = files[t].find(kTileWord) != std::string::npos;
    const auto found = is_file(folder / named) ? std::optional(named)
                       : is_tiled              ? std::nullopt
                                               : search_texture(folder, named, path.stem());
    if (found) {
      mesh.textures[t].bytes = read_file(folder / *found);
      continue;
    }
    mesh.notes.push_back(concat("its texture ", quoted(named.filename().string()),
                                is_tiled
                                    ? " has several tiles (UDIM) and is not used: an OBJ file "
                                      "with a material file can name it"
                                    : " is neither beside it nor in a subfolder and is not used"));
    mesh.textures.erase(mesh.textures.begin() + static_cast<std::ptrdiff_t>(t));
  }
}

std::filesystem::path find_unnamed_texture(const std::filesystem::path& path,
                                           std::string_view text) {
  for (const char* ending : {".mtl", ".png", ".PNG", ".jpg", ".JPG", ".jpeg", ".tif", ".tiff",
                             ".tga", ".exr", ".bmp", ".webp"}) {
    std::filesystem::path beside = path.parent_path() / (path.stem().string() + ending);
    if (!is_file(beside)) continue;
    const bool has_uvs = text.starts_with("vt ") || text.find("\nvt ") != text.npos;
    return has_uvs && text.find("mtllib ") == text.npos ? beside : std::filesystem::path();
  }
  return {};
}

bool is_material_file(const std::filesystem::path& path) {
  return lower_case(path.extension().string()) == ".mtl";
}

std::vector<MeshTexture> colour_textures(const std::filesystem::path& image,
                                         const std::vector<MaterialRange>& materials) {
  std::set<std::string> names;
  for (const MaterialRange& range : materials) names.insert(range.name);
  if (names.empty()) names.emplace();
  std::vector<MeshTexture> textures;
  const std::string bytes = read_file(image);
  for (const std::string& name : names) textures.push_back({name, TextureKind::kColour, bytes});
  return textures;
}

std::string write_mesh_textures(const FileMesh& mesh, const std::filesystem::path& folder,
                                const std::string& name) {
  make_directories(folder);
  std::map<std::string_view, std::string> files;  // file names by content
  std::map<std::string, std::string> statements;  // statements by material
  for (const MaterialRange& range : mesh.materials) statements[material_name_of(range.name)];
  for (const MeshTexture& texture : mesh.textures) {
    const auto [file, is_new] = files.try_emplace(texture.bytes);
    if (is_new) {
      file->second = concat(name, '_', files.size(), image_ending(texture.bytes));
      write_file(folder / file->second, texture.bytes);
    }
    statements[material_name_of(texture.material)] +=
        concat(mtl_statement_of(texture.kind).word, ' ', file->second, '\n');
  }
  std::string text;
  for (const auto& [material, lines] : statements) {
    text += concat("newmtl ", material, '\n', lines);
  }
  std::string library = name + ".mtl";
  write_file(folder / library, text);
  return library;
}

}  // namespace crowdface
