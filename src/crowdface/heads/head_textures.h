// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/head_texture_files.h"
#include "crowdface/render/texture.h"
#include "crowdface/texture/crowd_textures.h"

namespace crowdface {

/// The parts of an image file's name that are the same for all faces. The full name also contains
/// the face's id.
struct PictureName {
  /// part of a material's name, with a number if the part alone is not unique; empty if all images
  /// come from the same texture file
  std::string material;
  int tile = 0;  ///< UDIM tile number; 0: none
  TextureKind kind = TextureKind::kColour;
  /// Whether all texture files from which the image is blended have 8 bits per value, and whether
  /// at least one of these files has floats.
  bool all_files_have_8_bit_values = true, some_file_has_floats = false;
};

/// The heads' textures of one kind, for blending or for renders.
struct HeadTextures {
  /// The textures from which the faces' textures are blended; no images if faces have no textures
  /// of their own.
  CrowdTextures blended;
  /// the name of each image of the layout; empty if faces have no blended textures
  std::vector<PictureName> names;

  /// the textures of each head for renders; empty if surfaces have plain colours
  std::vector<TextureSet> texture_sets;
  /// hash of the files read, and of the texture that each polygon of each head uses
  Digest digest;
  std::vector<std::string> warnings;  ///< messages about missing files

  /// Whether each face gets textures that are blended from the heads' textures.
  bool are_blended() const { return !names.empty(); }
  bool has_textures() const { return are_blended() || !texture_sets.empty(); }
};

/// Maximum side length, in texels, of textures for renders: contact sheets cannot show finer
/// detail.
int max_rendered_texels(const Config::ContactSheet& sheet);

/// Whether renders show any of these kinds of textures.
bool are_any_rendered(const std::vector<HeadTextures>& maps);

/// Converts a blended colour image to a texture for renders.
/// \param max_px  maximum side length; larger images are downscaled
Texture texture_of(const BlendedPicture& colours, int max_px);

/// A face's own textures for renders: colours in linear light, and normals and roughness for
/// shading.
class FaceTextureSet {
 public:
  /// \param maps     textures of all kinds except colour
  /// \param target   head whose colours are used if colours are not blended
  /// \param max_px  maximum side length; larger images are downscaled
  FaceTextureSet(const HeadTextures& colours, const std::vector<HeadTextures>& maps, Index target,
                 int max_px);

  /// Adds an image. All images must be added before the set is used. Thread-safe.
  /// \param picture  index of the image: blended colour images come first, then the images of each
  ///                 other kind
  void add(std::size_t picture, const BlendedPicture& blended);
  const TextureSet& texture_set() const { return texture_set_; }

  /// Memory of a texture set made from these textures, in bytes.
  static std::uint64_t memory_bytes(const HeadTextures& colours,
                                    const std::vector<HeadTextures>& maps, int max_px);

 private:
  /// Identifies an image of the face.
  struct ImageIndex {
    TextureKind kind = TextureKind::kColour;
    std::size_t index = 0;  ///< index among the images of its kind
  };
  TextureSet texture_set_;
  /// kind and index of each image; the parameter `picture` of `add` is an index into this list
  std::vector<ImageIndex> image_indices_;
  int max_px_;  ///< maximum side length of textures, in texels
};

/// Adds a head's own normal and roughness maps to its texture set.
void add_shading_maps_of_head(const std::vector<HeadTextures>& maps, Index head, int max_px,
                              TextureSet& texture_set);

/// The texture set of an input head; nothing if the head has no texture.
std::optional<TextureSet> texture_set_of_head(const HeadTextures& textures, Index head, int max_px);

/// Loads the heads' textures for renders, without blending. Reads each file once. PNG, TIFF and
/// JPEG files count as sRGB, floats as linear light.
/// \param max_px  maximum side length; larger textures are downscaled
/// \throws InvalidInput that names the file if a file is damaged.
HeadTextures load_render_textures(FoundTextureFiles found, int max_px);

/// Loads textures of one kind for blending and converts all textures to the layout of the first
/// head with a texture. For each head, merges the files of an image into one image, whose longer
/// side has the length `size`.
/// \param size     texels of the longer side; nothing: the longer side of the largest file, but at
///                 most 4,096
/// \param cache    stores the converted textures, which are then mapped and not in memory
/// \throws InvalidInput if a file is damaged, or is not of the kind that its material says, such as
///     a grey image as a normal map.
HeadTextures load_blended_textures(const HeadSet& heads, const PolygonMaterials& materials,
                                   FoundTextureFiles found, std::optional<std::uint64_t> size,
                                   const CacheFolder& cache);

}  // namespace crowdface
