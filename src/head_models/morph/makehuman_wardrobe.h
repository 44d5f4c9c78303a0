// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "head_models/morph/makehuman_controls.h"
#include "head_models/morph/makehuman_heads.h"

namespace crowdface {

/// A skin texture of the package, and its weight in a person's blended skin.
struct WeightedSkin {
  std::filesystem::path picture;  ///< file of the texture
  double share = 0;               ///< weight of `picture` in the blended skin, 0 … 1
};

/// Returns the skin textures that are blended for a person, by sex, age and ancestry. The shares
/// sum to 1. \throws MissingInput, InvalidInput if a skin's file is missing or invalid.
std::vector<WeightedSkin> makehuman_skin_shares(const std::filesystem::path& package,
                                                const MakeHumanPerson& person, std::uint64_t seed,
                                                std::uint64_t index);

/// Returns a random factor, 0.6 to 1.25, on the optical density of a person's skin textures. The
/// mean is smaller for women and for old people.
double makehuman_skin_optical_density_factor(const MakeHumanPerson& person, std::uint64_t seed,
                                             std::uint64_t index);

/// Returns a factor on the detail of a person's skin texture. The wrinkles of old people in the
/// package are faint.
double makehuman_skin_detail_factor(const MakeHumanPerson& person);

/// Returns factors on the light (red, green, blue) that a person's lips reflect: women's lips are
/// redder than in the package's textures, and a third of the women wear lipstick.
std::array<double, 3> makehuman_lip_tint(const MakeHumanPerson& person, std::uint64_t seed,
                                         std::uint64_t index);

/// Returns a person's random eye colour: the name of a material of the package's eyes. "brown" has
/// a probability of 0.9 for African, 0.85 for Asian and 0.25 for Caucasian ancestry.
std::string makehuman_eye_colour(const MakeHumanPerson& person, std::uint64_t seed,
                                 std::uint64_t index);

/// How irises of an eye colour are made from a texture of the package.
struct IrisLook {
  std::string_view picture;  ///< name of the material whose texture is used
  double darkening;          ///< factor on the optical density of the texture's iris
  double greying;  ///< 0: the iris keeps the colour of the texture … 1: the iris is grey
};
/// Returns how irises of an eye colour are made. \param colour  a result of makehuman_eye_colour
IrisLook makehuman_iris_look(const std::string& colour);

/// Returns the random hair colour of a person's youth, before greying: a name of
/// named_hair_colours. Only people with Caucasian ancestry can get light or red hair.
std::string makehuman_hair_colour(const MakeHumanPerson& person, std::uint64_t seed,
                                  std::uint64_t index);

/// The parts that all heads have in addition to skin.
struct MakeHumanParts {
  std::vector<FittedPart> fitted_parts;  ///< the parts eyeball_r, eyeball_l, teeth and tongue
  std::vector<FittedMesh::Picture> eye_colours;  ///< iris textures of the package, by colour
  std::filesystem::path teeth, tongue;  ///< texture of the teeth, and texture of the tongue
  AssetLicence eyes_licence, teeth_licence, tongue_licence;
};

/// Reads eyes, teeth and tongue. Leaves out the corneas, which are transparent in the texture.
/// \param base  vertices of the base mesh.
/// \throws MissingInput; InvalidInput, also if an asset's licence is not free.
MakeHumanParts read_makehuman_parts(const std::filesystem::path& package, const Positions& base);

/// A mesh of the package that some heads wear: hair, a brow, lashes, a beard.
struct MakeHumanAttachment {
  std::string name;                  ///< name of the attachment, such as "bob01_left"
  std::string kind;                  ///< "hair", "brow", "lashes" or "beard"
  std::filesystem::path file;        ///< path of the mesh file
  std::vector<std::string> tags;     ///< tags that a head needs to wear the attachment
  bool excludes_old_people = false;  ///< whether old people never wear the attachment
  double relative_frequency = 1;     ///< relative frequency among attachments of the same kind
  bool is_mirrored = false;          ///< whether left and right of the mesh are exchanged
  double end;  ///< height at which hair is cut, in centimetres above the eyes; −∞: not cut
};

/// Returns the package's attachments that have a named author and a contemporary style, brows
/// first.
std::vector<MakeHumanAttachment> makehuman_attachments(const std::filesystem::path& package);

/// Returns the ancestry ("african", "asian" or "caucasian") whose share is above 0.5. Returns an
/// empty text if no share is above 0.5.
std::string prevailing_ancestry(const MakeHumanPerson& person);

}  // namespace crowdface
