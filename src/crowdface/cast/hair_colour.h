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
std::span<const NamedHairColour> named_hair_colours();
/// The colour with this name; nothing if no colour has it.
std::optional<HairColour> hair_colour_named(std::string_view name);

/// Which hair of a person an attachment with a neutral texture is. The attachment then takes the
/// colour of this hair on each face.
enum class Tint { kNone, kHair, kBrows, kBeard, kLashes };

/// The colour of a person's brows, beard or lashes: brows are darker and turn grey late, beards are
/// redder, lashes are darkest. Rounded.
/// \param hair  the colour of the scalp hair.
HairColour tinted(const HairColour& hair, Tint tint);

/// Rounds a colour to steps that are hardly visible, so that many faces share the same colour.
HairColour rounded_colour(const HairColour& colour);
/// Whether the pigments of a rounded colour are at most one step from those of `named`; grey may
/// differ.
bool is_shade_of(const HairColour& rounded, const HairColour& named);
/// Whether two colours look the same at first sight.
bool are_alike(const HairColour& a, const HairColour& b);

/// Returns "e55p10g20": the three values in percent, for names of folders and files.
std::string label_of(const HairColour& colour);
/// Reads what label_of returns.
std::optional<HairColour> parse_hair_label(std::string_view label);

/// Mean light (linear RGB) of neutral textures; sRGB 170.
inline constexpr float kNeutralLight = 0.4F;
/// Mean light of hair of a colour, linear RGB: the light that the pigments do not absorb
/// (Beer-Lambert law), plus a constant fraction that the surface of the hair reflects.
std::array<float, 3> light_of(const HairColour& colour);
/// The factors on a neutral texture's light that give it this colour, at most 1.
std::array<float, 3> tint_factors(const HairColour& colour);

}  // namespace crowdface
