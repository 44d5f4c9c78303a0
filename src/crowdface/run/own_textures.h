// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/io/own_materials.h"

namespace crowdface {

/// A file of a face's own textures.
struct OwnTextureFile {
  std::string name;                     ///< below the folder of the face's meshes
  std::size_t picture = 0, format = 0;  ///< of OwnTextures::Encoded
};
/// None if faces get no textures of their own.
std::vector<OwnTextureFile> own_texture_files(const Config& config, const Inputs& inputs,
                                              const std::string& id);

/// A picture that a GLB file holds. It knows no EXR, and nothing but colours, normals and roughness.
struct GlbPicture {
  std::size_t picture = 0;  ///< of own_pictures
  TextureFormat format = TextureFormat::kPng;
};
std::vector<GlbPicture> glb_pictures(const Config& config, const Inputs& inputs);

/// Where the pictures of glb_pictures lie for a face's mesh, in the first of their formats:
/// "./blended/ID.png". None if faces get no textures of their own.
std::vector<std::string> own_texture_names(const Config& config, const Inputs& inputs,
                                           const std::string& id);

/// "ID.mtl".
std::string material_file_name(const std::string& id);

/// Encodes the textures of faces, and writes their material files.
class OwnTextures {
 public:
  /// \param config, inputs  must outlive this object. \param crowd  all faces that may be written.
  /// \param shared  as MeshSource has it
  OwnTextures(const Config& config, const Inputs& inputs, std::span<const CastFace> crowd,
              const std::string& shared = {});

  /// The bytes of all pictures as own_pictures has them, each in all of its formats.
  using Encoded = std::vector<std::vector<std::string>>;

  /// \param number  of own_pictures. \return  it in each of its formats. Any thread may ask.
  std::vector<std::string> encode(std::size_t number, const BlendedPicture& picture) const;
  /// The ones that a GLB file holds: see glb_pictures.
  std::vector<std::string_view> of_mesh(const Encoded& encoded) const;
  /// The target's material file with the face's textures in place of the target's.
  EncodedFile material_file(const CastFace& face) const;

  /// About what the encoded pictures of one face take, and the encoding of the largest.
  std::uint64_t encode_bytes() const;

 private:
  /// The materials of a target, and which picture each of them shows: of own_pictures.
  struct Materials {
    OwnMaterials file;
    std::map<TextureKind, std::map<std::string, std::size_t>> pictures;
  };

  const Config& config_;
  const Inputs& inputs_;
  std::vector<PictureName> pictures_;
  std::map<Index, Materials> of_target_;
};

}  // namespace crowdface
