// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/mesh_textures.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/texture_search.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

/// The file extension for an image. The image's first bytes determine the extension, as they
/// determine the format when the image is read.
std::string_view image_ending(std::string_view bytes) {
  return bytes.starts_with("\x89PNG")          ? ".png"
         : bytes.starts_with("\xff\xd8")       ? ".jpg"
         : bytes.starts_with("RIFF")           ? ".webp"
         : bytes.starts_with("\xabKTX 20\xbb") ? ".ktx2"
                                               : ".tif";
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
