// SPDX-License-Identifier: Apache-2.0
#include "crowdface/synth/complexion.h"

#include <algorithm>
#include <array>

#include "crowdface/core/random.h"
#include "crowdface/core/smooth_step.h"

namespace crowdface::synth {
namespace {

ScreenColour from_bytes(double red, double green, double blue) {
  return ScreenColour(red, green, blue) / 255;
}

/// At t in [0, 1] along evenly spaced colours.
template <std::size_t N>
ScreenColour along(const std::array<ScreenColour, N>& colours, double t) {
  const double place = std::clamp(t, 0.0, 1.0) * (N - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), N - 2);
  const double part = place - static_cast<double>(i);
  return (1 - part) * colours[i] + part * colours[i + 1];
}

/// Faces' skin from very light to dark, about along the line that measured skin follows in CIELAB (Chardon and
/// others 1991, "Skin colour typology and suntanning pathways"): L* from 72 to 29, yellowness and
/// redness largest in the middle.
const auto& skin_tones() {
  static const std::array<ScreenColour, 8> tones = {
      from_bytes(201, 171, 151), from_bytes(192, 156, 135), from_bytes(181, 141, 120),
      from_bytes(167, 125, 102), from_bytes(149, 107, 84),  from_bytes(129, 91, 71),
      from_bytes(107, 75, 61),   from_bytes(87, 63, 55)};
  return tones;
}

/// From blond to black.
const auto& hair_colours() {
  static const std::array<ScreenColour, 5> colours = {
      from_bytes(172, 140, 96), from_bytes(128, 94, 62), from_bytes(84, 60, 44),
      from_bytes(52, 39, 32), from_bytes(30, 25, 24)};
  return colours;
}

}  // namespace

Complexion draw_complexion(std::uint64_t seed, std::uint64_t index) {
  const Person person = draw_person(seed, index);
  const bool male = person.male > 0;
  const auto unit = [&](const char* purpose) { return random_unit({seed, index, purpose}); };
  Complexion look;
  look.tone = random_stratified({seed, index, "synth/tone"}, 5);
  look.skin = along(skin_tones(), look.tone);
  // Light hair goes with light skin only.
  const double darkest = smooth_step(0.05, 0.55, look.tone);
  const double hair = darkest + (1 - darkest) * unit("synth/hair");
  const double grey = smooth_step(38, 74, person.age + 12 * (unit("synth/grey") - 0.5));
  look.hair = along(hair_colours(), hair);
  look.hair += grey * (from_bytes(168, 166, 164) - look.hair);
  look.ruddy = (0.35 + 0.65 * unit("synth/ruddy")) * (1 - 0.6 * look.tone);
  look.freckles = look.tone < 0.35 ? smooth_step(0.55, 1, unit("synth/freckles")) : 0;
  look.age_spots = smooth_step(48, 75, person.age) * unit("synth/spots");
  look.brows = (male ? 0.9 : 0.75) + 0.2 * (unit("synth/brow_density") - 0.5);
  look.brow_width = (male ? 1.15 : 0.68) + 0.3 * (unit("synth/brow_width") - 0.5);
  if (male) {
    const double kind = unit("synth/beard");
    look.beard = kind < 0.45 ? 0.2 : kind < 0.8 ? 0.55 : 1;
    look.receding = smooth_step(28, 80, person.age + 45 * (unit("synth/receding") - 0.5));
  } else {
    look.brow_arch = 0.25 + 0.2 * (unit("synth/brow_arch") - 0.5);
    look.made_up = 0.2 + 0.8 * unit("synth/made_up");
  }
  return look;
}

}  // namespace crowdface::synth
