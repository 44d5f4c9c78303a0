// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/complexion.h"

#include <algorithm>
#include <array>

#include "crowdface/core/random.h"
#include "crowdface/core/smooth_step.h"

namespace crowdface::synth {
namespace {

/// Interpolates linearly between evenly spaced colours at t, clamped to [0, 1].
template <std::size_t N>
ScreenColour along(const std::array<ScreenColour, N>& colours, double t) {
  const double place = std::clamp(t, 0.0, 1.0) * (N - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), N - 2);
  const double part = place - static_cast<double>(i);
  return (1 - part) * colours[i] + part * colours[i + 1];
}

/// Facial skin colours from very light to dark. The colours follow the distribution of measured
/// skin colours in CIELAB (Chardon et al. 1991, "Skin colour typology and suntanning pathways"): L*
/// from 72 to 29, a* and b* largest in the middle.
const auto& skin_tones() {
  static const std::array<ScreenColour, 8> tones = {
      from_bytes(201, 171, 151), from_bytes(192, 156, 135), from_bytes(181, 141, 120),
      from_bytes(167, 125, 102), from_bytes(149, 107, 84),  from_bytes(129, 91, 71),
      from_bytes(107, 75, 61),   from_bytes(87, 63, 55)};
  return tones;
}

/// Hair colours from blond to black.
const auto& natural_hair() {
  static const std::array<ScreenColour, 5> colours = {
      from_bytes(176, 146, 104), from_bytes(124, 96, 70), from_bytes(82, 62, 49),
      from_bytes(50, 40, 34), from_bytes(30, 26, 25)};
  return colours;
}

/// Returns a colour of the iris; light eyes occur only with light skin.
/// \param kind   0 … 1: from blue to brown.
/// \param light  0 … 1: brightness.
ScreenColour random_iris(double tone, double kind, double light) {
  static const std::array<ScreenColour, 6> colours = {
      from_bytes(84, 100, 114), from_bytes(90, 98, 94), from_bytes(84, 82, 62),
      from_bytes(88, 66, 44),   from_bytes(66, 44, 30), from_bytes(44, 30, 23)};
  const double brown = smooth_step(0.1, 0.5, tone);
  return (0.85 + 0.3 * light) * along(colours, brown + (1 - brown) * kind * 0.9);
}

/// Sets the beard for a uniform random number `kind` in [0, 1): 42 % shaven, 25 % stubble, 18 %
/// moustache (more than half of the moustaches with a chin beard), 15 % full beard.
void grow_beard(double kind, Complexion& look) {
  const double everywhere = kind < 0.42 ? 0.12 : kind < 0.67 ? 0.45 : kind < 0.85 ? 0.2 : 1;
  look.beard = look.moustache = look.chin_beard = everywhere;
  if (kind >= 0.67 && kind < 0.85) look.moustache = 1;
  if (kind >= 0.75 && kind < 0.85) look.chin_beard = 1;
}

}  // namespace

Complexion random_complexion(std::uint64_t seed, std::uint64_t index) {
  const Person person = random_person(seed, index);
  const bool male = person.maleness > 0;
  const auto unit = [&](const char* purpose) { return random_uniform({seed, index, purpose}); };
  Complexion look;
  look.skin_tone =
      random_stratified({seed, index / 2, male ? "synth/tone_of_men" : "synth/tone_of_women"}, 5);
  // Women's skin is lighter than men's (Jablonski and Chaplin 2000, "The evolution of human skin
  // coloration"). The difference is largest for dark skin. So darken men's skin and lighten women's
  // skin, in proportion to the skin tone (0: lightest).
  look.skin = along(skin_tones(), look.skin_tone) * (1 + (male ? -0.08 : 0.33) * look.skin_tone);
  // Light hair occurs only with light skin.
  const double darkest = smooth_step(0.15, 0.65, look.skin_tone);
  // Stratified random numbers: the three women among heads 6k to 6k + 5 get numbers in different
  // thirds of the range, and so do the three men.
  const double hair =
      darkest +
      (1 - darkest) * random_stratified(
                          {seed, index / 2, male ? "synth/hair_of_men" : "synth/hair_of_women"}, 3);
  const double grey = smooth_step(38, 74, person.age_years + 12 * (unit("synth/grey") - 0.5));
  look.hair = look.young_hair = along(natural_hair(), hair);
  look.brow_hair = 0.85 * (look.hair + 0.45 * grey * (from_bytes(150, 143, 137) - look.hair));
  look.hair += grey * (from_bytes(168, 166, 164) - look.hair);
  look.redness = (0.35 + 0.65 * unit("synth/ruddy")) * (1 - 0.75 * look.skin_tone);
  look.freckles = look.skin_tone < 0.35 ? smooth_step(0.55, 1, unit("synth/freckles")) : 0;
  look.age_spots = smooth_step(48, 72, person.age_years) * (0.4 + 0.6 * unit("synth/spots")) *
                   (1 - 0.6 * look.skin_tone);
  look.brow_density = (male ? 0.9 : 0.75) + 0.2 * (unit("synth/brow_density") - 0.5);
  look.brow_width = (male ? 1.15 : 0.85) + 0.3 * (unit("synth/brow_width") - 0.5);
  look.iris = random_iris(look.skin_tone, unit("synth/iris"), unit("synth/iris_light"));
  if (male) {
    // Use stratified random numbers, so that about two of five successive men are shaven, and so
    // that the hairlines of successive men differ.
    grow_beard(random_stratified({seed, index / 2, "synth/beard"}, 5), look);
    const double early = random_stratified({seed, index / 2, "synth/receding"}, 4);
    look.recession = smooth_step(28, 80, person.age_years + 45 * (early - 0.5));
  } else {
    look.brow_arch = 0.25 + 0.2 * (unit("synth/brow_arch") - 0.5);
    const double fond = unit("synth/made_up");
    look.makeup = (0.35 + 0.5 * fond * fond) * (1 - 0.5 * smooth_step(45, 70, person.age_years));
    look.lipstick = 0.7 * smooth_step(0.75, 0.9, fond);
  }
  return look;
}

}  // namespace crowdface::synth
