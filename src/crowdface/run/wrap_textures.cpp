// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/wrap_textures.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/merged_materials.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// The material name for the skin of a template whose polygons have no material.
constexpr const char* kSkinMaterial = "skin";

/// Returns the file name of a map: "anna.colour.png", or with part and tile
/// "anna.colour.PART.1001.png".
std::string map_name(const std::string& head, std::string_view kind, const PictureName& picture,
                     std::string_view tile) {
  return concat(head, '.', kind, picture.material.empty() ? "" : ".", picture.material,
                picture.tile == 0 ? "" : ".", picture.tile == 0 ? "" : tile, ".png");
}

}  // namespace

std::vector<fs::path> TextureFiles::all_paths() const {
  if (map_files.empty()) return {};
  std::vector<fs::path> files = {material_file};
  files.insert(files.end(), map_files.begin(), map_files.end());
  files.insert(files.end(), mask_files.begin(), mask_files.end());
  return files;
}

WrapTextures::WrapTextures(const WrapOptions& options, const WrapInputs& inputs)
    : inputs_(inputs),
      options_{.removes_shading = options.removes_shading},
      bake_template_(inputs.file, inputs.wrap_template, inputs.texture_size) {
  for (const std::string& warning : bake_template_.warnings()) log_warning(warning);
}

TextureFiles WrapTextures::files_of(const fs::path& head, const fs::path& reports) const {
  const std::string name = head.stem().string();
  TextureFiles files{head.parent_path() / (name + ".mtl"), {}, {}};
  for (const PictureName& picture : bake_template_.picture_names()) {
    const std::string tile = std::to_string(picture.tile);
    files.map_files.push_back(head.parent_path() / map_name(name, "colour", picture, tile));
    files.mask_files.push_back(reports / map_name(name, "filled", picture, tile));
  }
  return files;
}

std::string WrapTextures::materials_text(const TextureFiles& files) const {
  const std::string name = files.material_file.stem().string();
  MergedMaterials::Replacements textures;
  for (const auto& [material, picture] : bake_template_.pictures_by_material()) {
    textures[TextureKind::kColour][material.empty() ? kSkinMaterial : material] =
        map_name(name, "colour", bake_template_.picture_names()[picture], kTileWord);
  }
  return MergedMaterials(inputs_.file.material_path(), inputs_.file.material_libraries)
      .text(textures);
}

void WrapTextures::copy_other_textures(const fs::path& folder) const {
  const ObjFile& file = inputs_.file;
  NamedTextures named = find_textures(file.material_path(), file.material_libraries);
  std::set<fs::path> kept;
  for (const auto& [kind, of_material] : named.paths_by_kind) {
    for (const auto& [material, path] : of_material) {
      if (kind == TextureKind::kColour && bake_template_.pictures_by_material().contains(material))
        continue;
      kept.insert(path);
      for (const fs::path& tile : find_tiles(path)) kept.insert(tile);
    }
  }
  for (const MaterialFile& other :
       find_material_files(file.material_path(), file.material_libraries).files) {
    const fs::path to = folder / other.destination;
    if (!kept.contains(other.source) || path_exists(to)) continue;
    make_directories(to.parent_path());
    write_file(to, read_file(other.source));
  }
}

double WrapTextures::write(const WrapResult& result, const Scan& skin, const ScanColours& colours,
                           const TextureFiles& files) const {
  const ScanSurface surface(
      {inverse(result.pose).apply(skin.positions), skin.triangles, {}, skin.file_triangle_indices});
  const ScanBake bake(bake_template_, result.positions, surface, colours, options_);
  double filled = 0;
  for (std::size_t p = 0; p < files.map_files.size(); ++p) {
    const BakedPicture picture = bake.bake_picture(p);
    write_file(files.map_files[p], encode_png(picture.width, picture.height, 3, picture.srgb));
    write_file(files.mask_files[p],
               encode_png(picture.width, picture.height, 1, picture.mask_without_scan));
    filled += picture.share_without_scan / static_cast<double>(files.map_files.size());
  }
  copy_other_textures(files.material_file.parent_path());
  write_file(files.material_file, materials_text(files));
  return filled;
}

EncodedFile WrapTextures::with_material_lines(EncodedFile plain, const TextureFiles& files) const {
  std::string first = concat("mtllib ", files.material_file.filename().string());
  if (bake_template_.pictures_by_material().contains(""))
    first += concat("\nusemtl ", kSkinMaterial);
  if (plain.replace_line("mtllib", first)) return plain;
  EncodedFile with_materials(first + '\n');
  for (const std::string_view piece : plain.pieces()) with_materials.add_without_copy(piece);
  with_materials.share_ownership(std::make_shared<EncodedFile>(std::move(plain)));
  return with_materials;
}

void add_texture_files(const fs::path& scan, Hasher& hasher) {
  if (!is_obj(scan)) return;
  std::vector<std::string> libraries;
  const MappedFile file(scan);
  const std::string_view text = file.bytes();
  constexpr std::string_view kWord = "mtllib";
  for (std::size_t at = text.find(kWord); at != text.npos; at = text.find(kWord, at + 1)) {
    if (at > 0 && text[at - 1] != '\n') continue;
    const std::string_view line = text.substr(at, text.find_first_of("\r\n", at) - at);
    libraries.emplace_back(material_lines(line).front().arguments);
  }
  if (const fs::path unnamed = find_unnamed_texture(scan, text); !unnamed.empty()) {
    if (is_material_file(unnamed)) libraries.push_back(unnamed.filename().string());
    hasher.add(hash_file(unnamed).digest);
  }
  for (const MaterialFile& used : find_material_files(scan, libraries).files) {
    hasher.add(hash_file(used.source).digest);
  }
}

}  // namespace crowdface
