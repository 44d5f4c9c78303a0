// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/io/own_materials.h"

namespace crowdface {

/// A texture file of one face.
struct OwnTextureFile {
  std::string name;  ///< path relative to the folder of the face's meshes
  std::size_t picture_index = 0, format_index = 0;  ///< indices into OwnTextures::Encoded
};
/// Lists the texture files of the face `id`. Returns an empty list if faces use the textures of
/// their target heads and have none of their own.
std::vector<OwnTextureFile> own_texture_files(const Config& config, const Inputs& inputs,
                                              const std::string& id);

/// An image in a GLB file. GLB files contain only colour, normal and roughness maps, and no EXR
/// images.
struct GlbPicture {
  std::size_t picture_index = 0;  ///< index into face_picture_names
  TextureFormat format = TextureFormat::kPng;
};
/// Lists the images that each GLB file contains, in the order of face_picture_names.
std::vector<GlbPicture> glb_pictures(const Config& config, const Inputs& inputs);

/// For each image of glb_pictures: the path relative to a face's mesh, such as "./blended/ID.png".
/// If an image is written in several formats, returns the path of the first format. Empty if faces
/// have no textures of their own.
std::vector<std::string> own_texture_names(const Config& config, const Inputs& inputs,
                                           const std::string& id);

/// Name of a face's own material file: "ID.mtl".
std::string material_file_name(const std::string& id);

/// Encodes the textures of faces and makes the faces' material files.
class OwnTextures {
 public:
  /// \param config, inputs  must outlive this object.
  /// \param crowd   all faces that may be written
  /// \param shared  see MeshSource
  OwnTextures(const Config& config, const Inputs& inputs, std::span<const FacePlan> crowd,
              const std::string& shared = {});

  /// For each image of face_picture_names, and for each format of the image: the bytes of the
  /// encoded file.
  using Encoded = std::vector<std::vector<std::string>>;

  /// Encodes an image in each of its formats. Thread-safe. \param picture_index  index into
  /// face_picture_names
  std::vector<std::string> encode(std::size_t picture_index, const BlendedPicture& picture) const;
  /// The images that a GLB file contains (see glb_pictures).
  std::vector<std::string_view> glb_images(const Encoded& encoded) const;
  /// The material file of the target head, with the face's textures in place of the head's
  /// textures.
  EncodedFile material_file(const FacePlan& face) const;

  /// In bytes, approximately: the memory of all encoded images of one face plus the memory for
  /// encoding the largest image.
  std::uint64_t encoding_memory_bytes() const;

 private:
  /// The materials of a target head.
  struct Materials {
    MergedMaterials merged_materials;
    /// for each texture kind and material name: index of the image in face_picture_names
    std::map<TextureKind, std::map<std::string, std::size_t>> picture_indices;
  };

  const Config& config_;
  const Inputs& inputs_;
  std::vector<PictureName> pictures_;
  std::map<Index, Materials> materials_of_target_;
};

}  // namespace crowdface
