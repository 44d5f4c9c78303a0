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
#include "crowdface/heads/worn_textures.h"
#include "crowdface/render/texture.h"
#include "crowdface/texture/crowd_textures.h"

namespace crowdface {

/// What a picture of the blended texture is called, beside the face's id.
struct PictureName {
  std::string part;  ///< the material that it is for, if there are several; else empty
  int tile = 0;      ///< its UDIM number; 0: none
  TextureKind kind = TextureKind::kColour;
  /// Whether all heads' files hold bytes, and whether any holds floats.
  bool of_bytes = true, of_floats = false;
};

/// The textures of the heads of one kind, as far as anything needs them.
struct HeadTextures {
  /// Each face gets a texture of its own, blended from these; no pictures: it does not.
  CrowdTextures blended;
  std::vector<PictureName> names;  ///< #pictures of the layout

  std::vector<TextureCoat>
      coats;      ///< #heads, for pictures; or empty: surfaces have their own colours
  Digest digest;  ///< of the files read, and of which face of which head wears which
  std::vector<std::string> warnings;  ///< about files that are missing

  bool blend() const { return !names.empty(); }
  bool any() const { return blend() || !coats.empty(); }
};

/// Pixels a side that textures keep in pictures, if they have them: more no sheet shows.
int shown_texels(const Config::ContactSheet& sheet);

/// Whether pictures show any of these kinds.
bool any_is_shown(const std::vector<HeadTextures>& maps);

/// What pictures show of a face's own textures: colours in linear light, and how its normals and its
/// roughness have it reflect.
class OwnCoat {
 public:
  /// \param maps     all kinds but colours.
  /// \param target   whose colours the face bears if colours are not blended.
  /// \param most_px  larger pictures are made smaller: more than this no picture shows.
  OwnCoat(const HeadTextures& colours, const std::vector<HeadTextures>& maps, Index target,
          int most_px);

  /// \param picture  those of the colours come first, if these are blended, then those of one kind after the
  /// other. All must come, from any thread, before the coat is used.
  void add(std::size_t picture, const BlendedPicture& blended);
  const TextureCoat& coat() const { return coat_; }

  /// What a coat of these takes.
  static std::uint64_t bytes(const HeadTextures& colours, const std::vector<HeadTextures>& maps,
                             int most_px);

 private:
  struct Place {
    TextureKind kind = TextureKind::kColour;
    std::size_t number = 0;  ///< among the pictures of its kind
  };
  TextureCoat coat_;
  std::vector<Place> places_;  ///< of all pictures
  int most_px_;
};

/// Has the coat of a head reflect as its own maps say.
void add_finish_of_head(const std::vector<HeadTextures>& maps, Index head, int most_px,
                        TextureCoat& coat);

/// What a head wears itself; nothing if it has no texture.
std::optional<TextureCoat> coat_of_head(const HeadTextures& textures, Index head, int most_px);

/// Textures to be shown as the heads have them, each file read once. PNG, TIFF and JPEG are taken for
/// sRGB, floats for linear light.
/// \param most_px  larger textures are made smaller.
/// \throws InvalidInput if a file is damaged, naming it.
HeadTextures load_coats(HeadsTextures found, int most_px);

/// Textures of one kind to be blended, all brought to one layout, that of the first head that has any. Head by head the
/// files of a picture are made one, of the size of the largest or of `size`.
/// \param size     texels of the longer side; nothing: that of the largest, at most 4,096.
/// \param scratch  a folder for maps of which all would take more than half of the memory that images have left.
/// \throws InvalidInput as above, or if a file cannot be what it is named as, such as a grey one a normal map.
HeadTextures load_blended_textures(const FaceSet& faces, const FaceMaterials& materials,
                                   HeadsTextures found, std::optional<std::uint64_t> size,
                                   const std::filesystem::path& scratch);

}  // namespace crowdface
