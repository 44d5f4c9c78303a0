// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace crowdface {

/// A hair colour, described by the concentrations of two pigments and by the fraction of hairs
/// without pigment, each in [0, 1].
struct HairColour {
  /// concentration of the brown to black pigment: 0.2 gives blond hair, 1 black hair
  double eumelanin = 0;
  double pheomelanin = 0;    ///< concentration of the red pigment, from 0 to 1
  double grey_fraction = 0;  ///< fraction of hairs without pigment (white hairs)
  bool operator==(const HairColour&) const = default;
};

/// A hair colour that has a name. A config names the colour by this name (`red`); tags of heads
/// append `_hair` to the name (`red_hair`).
struct NamedHairColour {
  std::string_view name;
  HairColour colour;
};
/// Returns all named hair colours.
std::span<const NamedHairColour> named_hair_colours();
/// Returns the hair colour with this name; nothing if the name is unknown.
std::optional<HairColour> hair_colour_named(std::string_view name);

/// The kind of hair (on the scalp, brows and so on) that an attachment with a neutral texture
/// represents. On each face, the attachment gets the colour of the face's hair of this kind.
enum class Tint { kNone, kHair, kBrows, kBeard, kLashes };

/// Returns the colour of a person's brows, beard or lashes (see `tint`), given the colour of the
/// scalp hair. The result is rounded like by rounded_colour. Brows are darker than the scalp hair
/// and turn grey late, beards are redder, and lashes are darkest.
///
/// \param hair  the colour of the scalp hair.
HairColour hair_colour_for(const HairColour& hair, Tint tint);

/// Rounds the three values of a colour to multiples of a step, so that many faces have exactly the
/// same colour. The steps (1/20 for eumelanin, 1/10 for the other values) are hardly visible.
HairColour rounded_colour(const HairColour& colour);
/// Returns whether the concentrations of both pigments in `rounded` differ from the concentrations
/// in `named` by at most one rounding step (see rounded_colour). The fractions of white hairs are
/// not compared.
bool is_shade_of(const HairColour& rounded, const HairColour& named);
/// Returns whether white hairs hide the pigments: with a third of white hairs, red hair looks grey.
bool looks_grey(const HairColour& colour);
/// Returns whether two colours look the same at first sight.
bool are_alike(const HairColour& a, const HairColour& b);

/// Returns a label such as "e55p10g20", which contains the three values in percent, for names of
/// folders and files.
std::string colour_label(const HairColour& colour);
/// Parses a label such as "e55p10g20", as returned by colour_label.
std::optional<HairColour> parse_hair_label(std::string_view label);

/// Mean value of neutral textures in linear RGB. As 8-bit sRGB, this is 170.
inline constexpr float kNeutralTextureMean = 0.4F;
/// Returns the mean light that hair of this colour reflects, in linear RGB, at most
/// kNeutralTextureMean. A pigmented hair reflects the light that the pigments do not absorb
/// (Beer-Lambert law), plus a constant fraction at the hair's surface. A hair without pigment
/// reflects a constant fraction.
std::array<float, 3> reflected_light(const HairColour& colour);
/// Returns the factors, at most 1, by which the linear RGB values of a neutral texture are
/// multiplied to give the texture this hair colour.
std::array<float, 3> tint_factors(const HairColour& colour);

}  // namespace crowdface
