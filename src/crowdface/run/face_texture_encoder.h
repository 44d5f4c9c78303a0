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
#include "crowdface/io/merged_materials.h"

namespace crowdface {

/// A texture file of one face.
struct FaceTextureFile {
  std::string name;  ///< path relative to the folder of the face's meshes
  /// The content of the file is encoded[picture_index][format_index], where `encoded` is a
  /// FaceTextureEncoder::Encoded.
  std::size_t picture_index = 0, format_index = 0;
};
/// Lists the texture files of the face `id`. Returns an empty list if faces have no blended
/// textures and use the textures of their target heads.
std::vector<FaceTextureFile> face_texture_files(const Config& config, const Inputs& inputs,
                                                const std::string& id);

/// An image in a GLB file. GLB files contain only colour, normal and roughness maps, and no EXR
/// images.
struct GlbPicture {
  std::size_t picture_index = 0;  ///< index into face_picture_names
  TextureFormat format = TextureFormat::kPng;
};
/// Lists the images that each GLB file contains, in the order of face_picture_names.
std::vector<GlbPicture> glb_pictures(const Config& config, const Inputs& inputs);

/// For each image of glb_pictures: its path relative to the mesh of the face `id`, such as
/// "./blended/ID.png". If an image is written in several formats, this is the path of the first
/// format. Empty if faces have no blended textures.
std::vector<std::string> face_picture_paths(const Config& config, const Inputs& inputs,
                                            const std::string& id);

/// Name of the material file of the face `id`: "ID.mtl".
std::string material_file_name(const std::string& id);

/// Encodes the blended textures of faces as image files, and writes the faces' material files.
class FaceTextureEncoder {
 public:
  /// \param config, inputs  must outlive this object.
  /// \param crowd   all faces that may be written
  /// \param shared  see MeshSource::shared_folder
  FaceTextureEncoder(const Config& config, const Inputs& inputs, std::span<const FacePlan> crowd,
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

  /// Approximate memory, in bytes, of all encoded images of one face, plus the memory for encoding
  /// the largest image.
  std::uint64_t encoding_memory_bytes() const;

 private:
  /// The materials of a target head.
  struct Materials {
    MergedMaterials merged_materials;  ///< all material files of the head, merged into one file
    /// for each texture kind and material name: index of the image in face_picture_names
    std::map<TextureKind, std::map<std::string, std::size_t>> picture_indices;
  };

  const Config& config_;
  const Inputs& inputs_;
  std::vector<PictureName> pictures_;  ///< names of the images of a face, from face_picture_names
  /// the materials of each target head; the key is the index of the head
  std::map<Index, Materials> materials_of_target_;
};

}  // namespace crowdface
