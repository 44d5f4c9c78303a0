// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace crowdface {

/// A hair colour on the natural scale: pigment concentrations and the fraction of hairs without
/// pigment, each in [0, 1].
struct HairColour {
  double eumelanin = 0;    ///< brown to black pigment: 0.2 blond, 1 black
  double pheomelanin = 0;  ///< red pigment
  double grey = 0;         ///< fraction of white hairs
  bool operator==(const HairColour&) const = default;
};

/// A name for a hair colour in configs and in heads' tags, such as `red` and `red_hair`.
struct NamedHairColour {
  std::string_view name;
  HairColour colour;
};
/// Returns all named hair colours.
std::span<const NamedHairColour> named_hair_colours();
/// Returns the hair colour with this name; nothing if the name is unknown.
std::optional<HairColour> hair_colour_named(std::string_view name);

/// The kind of hair that an attachment with a neutral texture represents. On each face, the
/// attachment gets the colour of the person's hair of this kind.
enum class Tint { kNone, kHair, kBrows, kBeard, kLashes };

/// Returns the rounded colour of a person's brows, beard or lashes: brows are darker than the scalp
/// hair and turn grey late, beards are redder, lashes are darkest.
/// \param hair  the colour of the scalp hair.
HairColour hair_colour_for(const HairColour& hair, Tint tint);

/// Rounds a colour to steps that are hardly visible, so that many faces share the same colour.
HairColour rounded_colour(const HairColour& colour);
/// Whether each pigment of a rounded colour is at most one step from the same pigment of `named`;
/// grey may differ.
bool is_shade_of(const HairColour& rounded, const HairColour& named);
/// Whether two colours look the same at first sight.
bool are_alike(const HairColour& a, const HairColour& b);

/// Returns "e55p10g20": the three values in percent, for names of folders and files.
std::string colour_label(const HairColour& colour);
/// Parses a label that colour_label returns.
std::optional<HairColour> parse_hair_label(std::string_view label);

/// Mean value of neutral textures, linear RGB; 170 in 8-bit sRGB.
inline constexpr float kNeutralTextureMean = 0.4F;
/// Mean reflected light of hair of this colour, linear RGB: the light that the pigments do not
/// absorb (Beer-Lambert law), plus a constant fraction that the surface of the hair reflects.
std::array<float, 3> reflected_light(const HairColour& colour);
/// Factors on the linear RGB values of a neutral texture, at most 1, that give the texture this
/// colour.
std::array<float, 3> tint_factors(const HairColour& colour);

}  // namespace crowdface
