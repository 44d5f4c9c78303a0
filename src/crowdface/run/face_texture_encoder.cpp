// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_texture_encoder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/tile_files.h"
#include "crowdface/render/shading.h"

namespace crowdface {
namespace {

std::string_view ending_of(TextureFormat format) {
  constexpr std::array<std::string_view, 3> kEndings = {".png", ".jpg", ".exr"};
  return kEndings[static_cast<std::size_t>(format)];
}

/// Path of an image file of the face `id`, relative to the folder of the meshes.
/// \param tile  a UDIM number or the text <UDIM>; empty if the image is not a tile
std::string file_name(const std::string& id, const PictureName& picture, std::string_view tile,
                      TextureFormat format) {
  const bool is_colour = picture.kind == TextureKind::kColour;
  return concat(kBlendedFolder, '/', id, picture.material.empty() ? "" : ".", picture.material,
                is_colour ? "" : concat('.', mtl_statement_of(picture.kind).name),
                tile.empty() ? "" : ".", tile, ending_of(format));
}

std::string file_name(const std::string& id, const PictureName& picture, TextureFormat format) {
  return file_name(id, picture, picture.tile == 0 ? "" : std::to_string(picture.tile), format);
}

std::string encode_exr_of(const BlendedPicture& picture) {
  std::vector<float> pixels;
  if (picture.values_16_bit.empty()) {
    const std::array<float, 256>& light = linear_of_srgb8();
    for (const std::uint8_t value : picture.srgb) pixels.push_back(light[value]);
  } else {
    for (const std::uint16_t word : picture.values_16_bit) {
      pixels.push_back(picture.low + picture.step * static_cast<float>(word));
    }
  }
  return encode_exr(picture.width, picture.height, picture.channels, pixels);
}

std::string encode_words(const BlendedPicture& picture, bool as_bytes) {
  if (!as_bytes) {
    return encode_png16(picture.width, picture.height, picture.channels, picture.values_16_bit);
  }
  constexpr std::uint32_t kWordsPerByte = 257;
  std::vector<std::uint8_t> bytes(picture.values_16_bit.size());
  std::ranges::transform(picture.values_16_bit, bytes.begin(), [](std::uint32_t word) {
    return static_cast<std::uint8_t>((word + kWordsPerByte / 2) / kWordsPerByte);
  });
  return encode_png(picture.width, picture.height, picture.channels, bytes);
}

std::string encode_picture(const BlendedPicture& picture, const PictureName& name,
                           TextureFormat format) {
  if (format == TextureFormat::kExr) return encode_exr_of(picture);
  if (!picture.values_16_bit.empty())
    return encode_words(picture, name.all_files_have_8_bit_values);
  return format == TextureFormat::kJpeg
             ? encode_jpeg(picture.width, picture.height, picture.srgb)
             : encode_png(picture.width, picture.height, 3, picture.srgb);
}

constexpr std::uint64_t kChannels = 3;  // maximum number of channels of a texture

/// Maximum size of an encoded image, in bytes per texel and channel.
std::uint64_t bytes_per_channel(const PictureName& picture, TextureFormat format) {
  if (format == TextureFormat::kExr) return sizeof(float);
  return picture.all_files_have_8_bit_values || picture.kind == TextureKind::kColour
             ? 1
             : sizeof(std::uint16_t);
}

/// Maps each material name of a head to the index of the material's image in a texture layout.
std::map<std::string, std::size_t> pictures_of_materials(const Inputs& inputs,
                                                         const TextureLayout& layout, Index head) {
  const PolygonMaterials materials =
      polygon_materials(inputs.head_files[static_cast<std::size_t>(head)].materials,
                        inputs.head_set.topology.face_count());
  std::map<std::string, std::size_t> pictures;
  for (std::size_t f = 0; f < layout.picture_of_polygon.size(); ++f) {
    if (layout.picture_of_polygon[f] == kNoIndex) continue;
    pictures.try_emplace(materials.names[materials.material_of_polygon[f]],
                         layout.picture_of_polygon[f]);
  }
  return pictures;
}

/// The file formats in which a face's image is written. Colour images use the config's formats.
/// Other kinds of images use PNG instead of JPEG, because JPEG would blur the values. A height
/// map that at least one head stores as floats uses only EXR.
std::vector<TextureFormat> formats_of(const Config& config, const PictureName& picture) {
  if (picture.kind == TextureKind::kColour) return config.textures.formats;
  const bool is_height =
      picture.kind == TextureKind::kDisplacement || picture.kind == TextureKind::kBump;
  if (is_height && picture.some_file_has_floats) return {TextureFormat::kExr};
  std::vector<TextureFormat> formats;
  for (TextureFormat format : config.textures.formats) {
    if (format == TextureFormat::kJpeg) format = TextureFormat::kPng;
    if (!contains(formats, format)) formats.push_back(format);
  }
  return formats;
}

}  // namespace

std::string material_file_name(const std::string& id) {
  return id + ".mtl";
}

std::vector<GlbPicture> glb_pictures(const Config& config, const Inputs& inputs) {
  std::vector<GlbPicture> result;
  const std::vector<PictureName> pictures = face_picture_names(inputs);
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    const TextureKind kind = pictures[p].kind;
    if (kind != TextureKind::kColour && kind != TextureKind::kNormal &&
        kind != TextureKind::kRoughness) {
      continue;
    }
    for (const TextureFormat format : formats_of(config, pictures[p])) {
      if (format == TextureFormat::kExr) continue;
      result.push_back({p, format});
      break;
    }
  }
  return result;
}

std::vector<FaceTextureFile> face_texture_files(const Config& config, const Inputs& inputs,
                                                const std::string& id) {
  std::vector<FaceTextureFile> files;
  const std::vector<PictureName> pictures = face_picture_names(inputs);
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    const std::vector<TextureFormat> formats = formats_of(config, pictures[p]);
    for (std::size_t f = 0; f < formats.size(); ++f) {
      files.push_back({file_name(id, pictures[p], formats[f]), p, f});
    }
  }
  return files;
}

std::vector<std::string> face_picture_paths(const Config& config, const Inputs& inputs,
                                            const std::string& id) {
  std::vector<std::string> names;
  const std::vector<PictureName> pictures = face_picture_names(inputs);
  for (const GlbPicture& held : glb_pictures(config, inputs)) {
    const PictureName& picture = pictures[held.picture_index];
    names.push_back("./" + file_name(id, picture, formats_of(config, picture).front()));
  }
  return names;
}

FaceTextureEncoder::FaceTextureEncoder(const Config& config, const Inputs& inputs,
                                       std::span<const FacePlan> crowd, const std::string& shared)
    : config_(config), inputs_(inputs), pictures_(face_picture_names(inputs)) {
  for (const FacePlan& face : crowd) {
    const Index target = face.recipe.target;
    if (materials_of_target_.contains(target)) continue;
    const ObjFile& file = inputs.head_files[static_cast<std::size_t>(target)];
    Materials materials{MergedMaterials(file.material_path(), file.material_libraries, shared), {}};
    std::size_t first = 0;
    const auto add = [&](const HeadTextures& textures) {
      if (!textures.are_blended()) return;
      auto& of_kind = materials.picture_indices[textures.names.front().kind];
      of_kind = pictures_of_materials(inputs, textures.blended.layout, target);
      for (auto& [material, picture_index] : of_kind) picture_index += first;
      first += textures.names.size();
    };
    add(inputs.textures);
    for (const HeadTextures& maps : inputs.other_textures) add(maps);
    materials_of_target_.emplace(target, std::move(materials));
  }
}

std::vector<std::string> FaceTextureEncoder::encode(std::size_t picture_index,
                                                    const BlendedPicture& picture) const {
  std::vector<std::string> encoded;
  for (const TextureFormat format : formats_of(config_, pictures_[picture_index])) {
    encoded.push_back(encode_picture(picture, pictures_[picture_index], format));
  }
  return encoded;
}

std::vector<std::string_view> FaceTextureEncoder::glb_images(const Encoded& encoded) const {
  std::vector<std::string_view> held;
  for (const auto& [picture_index, format] : glb_pictures(config_, inputs_)) {
    const std::vector<TextureFormat> formats = formats_of(config_, pictures_[picture_index]);
    const auto at = std::find(formats.begin(), formats.end(), format) - formats.begin();
    held.emplace_back(encoded[picture_index][static_cast<std::size_t>(at)]);
  }
  return held;
}

EncodedFile FaceTextureEncoder::material_file(const FacePlan& face) const {
  const Materials& materials = materials_of_target_.at(face.recipe.target);
  MergedMaterials::Replacements textures;
  for (const auto& [kind, picture_indices] : materials.picture_indices) {
    for (const auto& [material, index] : picture_indices) {
      const PictureName& picture = pictures_[index];
      textures[kind][material] = file_name(face.id, picture, picture.tile == 0 ? "" : kTileWord,
                                           formats_of(config_, picture).front());
    }
  }
  return {materials.merged_materials.text(textures)};
}

std::uint64_t FaceTextureEncoder::encoding_memory_bytes() const {
  std::uint64_t bytes = 0, largest = 0;
  std::size_t picture = 0;
  const auto add = [&](const HeadTextures& textures) {
    for (const TextureLayout::Picture& size : textures.blended.layout.pictures) {
      const std::uint64_t texels =
          static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
      const PictureName& name = pictures_[picture++];
      for (const TextureFormat format : formats_of(config_, name)) {
        bytes += kChannels * texels * bytes_per_channel(name, format);
      }
      largest = std::max(largest, texels);
    }
  };
  add(inputs_.textures);
  for (const HeadTextures& maps : inputs_.other_textures) add(maps);
  return bytes + kChannels * sizeof(float) * largest;
}

}  // namespace crowdface
