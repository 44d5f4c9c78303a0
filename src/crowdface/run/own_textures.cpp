// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/own_textures.h"

#include <algorithm>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

/// \param tile  a number, or <UDIM>; empty for a picture that is no tile.
std::string file_name(const std::string& id, const PictureName& picture, std::string_view tile,
                      TextureFormat format) {
  return concat(kBlendedFolder, '/', id, picture.part.empty() ? "" : ".", picture.part,
                tile.empty() ? "" : ".", tile, format == TextureFormat::kJpeg ? ".jpg" : ".png");
}

std::string encode_picture(const BlendedPicture& picture, TextureFormat format) {
  return format == TextureFormat::kJpeg
             ? encode_jpeg(picture.width, picture.height, picture.srgb)
             : encode_png(picture.width, picture.height, 3, picture.srgb, PngEffort::kFast);
}

bool has(std::span<const MeshFormat> meshes, MeshFormat format) {
  return std::find(meshes.begin(), meshes.end(), format) != meshes.end();
}

std::map<std::string, std::size_t> pictures_of_materials(const Inputs& inputs, Index head) {
  const TextureLayout& layout = inputs.textures.blended.layout;
  const FaceMaterials materials = face_materials(
      inputs.files[static_cast<std::size_t>(head)].materials, inputs.faces.topology.face_count());
  std::map<std::string, std::size_t> pictures;
  for (std::size_t f = 0; f < layout.of_face.size(); ++f) {
    if (layout.of_face[f] == kNoIndex) continue;
    pictures.try_emplace(materials.names[materials.of_face[f]], layout.of_face[f]);
  }
  return pictures;
}

}  // namespace

std::string material_file_name(const std::string& id) {
  return id + ".mtl";
}

std::vector<std::string> own_file_names(const Config& config, const Inputs& inputs,
                                        std::span<const MeshFormat> meshes, const std::string& id) {
  std::vector<std::string> names;
  const bool all_glb = std::all_of(meshes.begin(), meshes.end(),
                                   [](MeshFormat format) { return format == MeshFormat::kGlb; });
  if (!inputs.textures.blend() || all_glb) return names;
  for (const PictureName& picture : inputs.textures.names) {
    for (const TextureFormat format : config.textures.formats) {
      names.push_back(
          file_name(id, picture, picture.tile == 0 ? "" : std::to_string(picture.tile), format));
    }
  }
  if (has(meshes, MeshFormat::kObj)) names.push_back(material_file_name(id));
  return names;
}

std::vector<std::string> own_texture_names(const Config& config, const Inputs& inputs,
                                           const std::string& id) {
  std::vector<std::string> names;
  if (!inputs.textures.blend()) return names;
  for (const PictureName& picture : inputs.textures.names) {
    names.push_back("./" + file_name(id, picture,
                                     picture.tile == 0 ? "" : std::to_string(picture.tile),
                                     config.textures.formats.front()));
  }
  return names;
}

OwnTextures::OwnTextures(const Config& config, const Inputs& inputs,
                         std::span<const CastFace> crowd, const std::string& shared)
    : config_(config), inputs_(inputs) {
  for (const CastFace& face : crowd) {
    const Index target = face.recipe.target;
    if (of_target_.contains(target)) continue;
    const ObjFile& file = inputs.files[static_cast<std::size_t>(target)];
    of_target_.emplace(target, Materials{OwnMaterials(file.path, file.material_libraries, shared),
                                         pictures_of_materials(inputs, target)});
  }
}

std::vector<std::string> OwnTextures::encode(const std::vector<BlendedPicture>& pictures) const {
  const auto& formats = config_.textures.formats;
  std::vector<std::string> encoded(pictures.size() * formats.size());
  parallel_for_each(encoded.size(), [&](std::size_t i) {
    encoded[i] = encode_picture(pictures[i / formats.size()], formats[i % formats.size()]);
  });
  return encoded;
}

std::vector<std::string_view> OwnTextures::of_mesh(const std::vector<std::string>& encoded) const {
  std::vector<std::string_view> first;
  for (std::size_t i = 0; i < encoded.size(); i += config_.textures.formats.size()) {
    first.emplace_back(encoded[i]);
  }
  return first;
}

std::vector<OwnFile> OwnTextures::files(const CastFace& face, std::span<const MeshFormat> meshes,
                                        std::vector<std::string> encoded) const {
  std::vector<OwnFile> files;
  for (std::string& name : own_file_names(config_, inputs_, meshes, face.id)) {
    files.push_back({std::move(name), {}});
  }
  if (files.empty()) return files;
  for (std::size_t i = 0; i < encoded.size(); ++i) files[i].bytes = std::move(encoded[i]);
  if (!has(meshes, MeshFormat::kObj)) return files;
  const Materials& materials = of_target_.at(face.recipe.target);
  std::map<std::string, std::string> colours;
  for (const auto& [material, index] : materials.pictures) {
    const PictureName& picture = inputs_.textures.names[index];
    colours[material] = file_name(face.id, picture, picture.tile == 0 ? "" : kTileWord,
                                  config_.textures.formats.front());
  }
  files.back().bytes = materials.file.text(colours);
  return files;
}

std::uint64_t OwnTextures::encode_bytes() const {
  std::uint64_t texels = 0;
  for (const TextureLayout::Picture& picture : inputs_.textures.blended.layout.pictures) {
    texels +=
        static_cast<std::uint64_t>(picture.width) * static_cast<std::uint64_t>(picture.height);
  }
  return 12 * texels;  // files and their copies, then what is rendered
}

}  // namespace crowdface
