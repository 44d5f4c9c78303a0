// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "head_models/morph/makehuman_controls.h"
#include "head_models/morph/makehuman_heads.h"

namespace crowdface {

/// A picture of the package's skins and how much of it a person's skin has.
struct SkinShare {
  std::filesystem::path picture;
  double share = 0;
};

/// The pictures that a person's skin is mixed from, by sex, age and ancestries; shares sum to one.
/// \throws MissingInput, InvalidInput about a skin's file.
std::vector<SkinShare> makehuman_skin(const std::filesystem::path& package,
                                      const MakeHumanPerson& person, std::uint64_t seed,
                                      std::uint64_t index);

/// How dense a person's pigments are, against the pictures': 0.75 to 1.25.
double makehuman_skin_tone(std::uint64_t seed, std::uint64_t index);

/// The colour of a person's eyes, a material of the package's eyes: "brown", mostly, in Africans and
/// Asians.
std::string makehuman_eye_colour(const MakeHumanPerson& person, std::uint64_t seed,
                                 std::uint64_t index);

/// What all dressed heads have beside skin, in one mesh each.
struct MakeHumanParts {
  std::vector<WornPart> worn;  ///< eyeball_r, eyeball_l, eyelashes, teeth, tongue
  std::vector<FittedMesh::Picture> eye_colours;
  std::filesystem::path lashes, teeth, tongue;  ///< pictures
  AssetLicence eyes_licence, lashes_licence, teeth_licence, tongue_licence;
};

/// Reads eyes, lashes, teeth and tongue. Corneas, which the picture leaves clear, are left out.
/// Lashes hold to the skin: the base mesh's own helpers for them lie metres off in some targets.
/// \param base  vertices of the base mesh. \param skin  those of the head's skin.
/// \throws MissingInput, InvalidInput; also if an asset's licence is not free.
MakeHumanParts read_makehuman_parts(const std::filesystem::path& package, const Positions& base,
                                    const std::vector<std::uint32_t>& skin);

/// A mesh of the package that some heads wear: hair, a brow, a beard.
struct MakeHumanAttachment {
  std::string name, kind;
  std::filesystem::path file;     ///< in the package
  std::vector<std::string> tags;  ///< of the heads that may wear it
  std::string colour;             ///< of hair and beards; empty: of brows
  bool dyed = false;              ///< its picture is given that colour
  double share = 1;
};

/// Those with a named author that suit a crowd of today, brows first.
std::vector<MakeHumanAttachment> makehuman_attachments(const std::filesystem::path& package);

/// "african", "asian" or "caucasian" where that is more than half of a person, else nothing.
std::string prevailing_ancestry(const MakeHumanPerson& person);

}  // namespace crowdface
