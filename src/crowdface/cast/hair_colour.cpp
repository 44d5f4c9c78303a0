// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/hair_colour.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

// The concentrations of the two pigments, and the fraction of white hairs, are rounded to multiples
// of 1 divided by these numbers.
constexpr double kEumelaninSteps = 20, kPheomelaninSteps = 10, kGreySteps = 10;

double to_step(double value, double steps) {
  return std::floor(std::clamp(value, 0.0, 1.0) * steps + 0.5) / steps;
}

int percent(double value) {
  return static_cast<int>(std::lround(100 * value));
}

}  // namespace

std::span<const NamedHairColour> named_hair_colours() {
  static constexpr auto kColours = std::to_array<NamedHairColour>({
      {"blond", {0.2, 0, 0}},
      {"strawberry_blond", {0.15, 0.4, 0}},
      {"red", {0.25, 0.8, 0}},
      {"auburn", {0.5, 0.6, 0}},
      {"light_brown", {0.35, 0, 0}},
      {"brown", {0.5, 0, 0}},
      {"dark_brown", {0.7, 0, 0}},
      {"black", {1, 0, 0}},
      {"grey", {0.6, 0, 0.6}},
      {"white", {0.4, 0, 1}},
  });
  return kColours;
}

std::optional<HairColour> hair_colour_named(std::string_view name) {
  const auto colours = named_hair_colours();
  const auto found = std::ranges::find(colours, name, &NamedHairColour::name);
  return found == colours.end() ? std::nullopt : std::optional(found->colour);
}

HairColour hair_colour_for(const HairColour& hair, Tint tint) {
  HairColour own = hair;
  if (tint == Tint::kBrows) {
    own.eumelanin += 0.1 + 0.15 * (1 - hair.eumelanin);
    own.grey_fraction = 0.6 * hair.grey_fraction * hair.grey_fraction;
  } else if (tint == Tint::kBeard) {
    own.eumelanin -= 0.05;
    own.pheomelanin += 0.15 * (1 - hair.eumelanin);
    own.grey_fraction = 0.9 * hair.grey_fraction;
  } else if (tint == Tint::kLashes) {
    own.eumelanin += 0.3;
    own.grey_fraction = 0.2 * hair.grey_fraction;
  }
  return rounded_colour(own);
}

HairColour rounded_colour(const HairColour& colour) {
  return {to_step(colour.eumelanin, kEumelaninSteps),
          to_step(colour.pheomelanin, kPheomelaninSteps),
          to_step(colour.grey_fraction, kGreySteps)};
}

bool is_shade_of(const HairColour& rounded, const HairColour& named) {
  constexpr double kRounding = 1e-9;
  return std::abs(rounded.eumelanin - named.eumelanin) < 1.0 / kEumelaninSteps + kRounding &&
         std::abs(rounded.pheomelanin - named.pheomelanin) < 1.0 / kPheomelaninSteps + kRounding;
}

bool looks_grey(const HairColour& colour) {
  constexpr double kGreyFrom = 0.25;
  return colour.grey_fraction >= kGreyFrom;
}

bool are_alike(const HairColour& a, const HairColour& b) {
  constexpr double kRounding = 1e-9;
  return std::abs(a.eumelanin - b.eumelanin) < 0.1 + kRounding &&
         std::abs(a.pheomelanin - b.pheomelanin) < 0.2 + kRounding &&
         std::abs(a.grey_fraction - b.grey_fraction) < 0.2 + kRounding;
}

std::string colour_label(const HairColour& colour) {
  return concat('e', percent(colour.eumelanin), 'p', percent(colour.pheomelanin), 'g',
                percent(colour.grey_fraction));
}

std::optional<HairColour> parse_hair_label(std::string_view label) {
  HairColour colour;
  for (const auto& [letter, value] : {std::pair{'e', &colour.eumelanin},
                                      {'p', &colour.pheomelanin},
                                      {'g', &colour.grey_fraction}}) {
    const std::size_t end = std::min(label.find_first_not_of("0123456789", 1), label.size());
    if (label.empty() || label[0] != letter) return std::nullopt;
    const auto number = parse_unsigned(label.substr(1, end - 1));
    if (!number || *number > 100) return std::nullopt;
    *value = static_cast<double>(*number) / 100;
    label.remove_prefix(end);
  }
  return label.empty() ? std::optional(colour) : std::nullopt;
}

std::array<float, 3> reflected_light(const HairColour& colour) {
  // Each array has the values for red, green and blue. All constants are fitted to the reflectance
  // of blond, brown, black, copper and white hair:
  // - kSurface: reflectance of the hair's surface.
  // - kWithoutPigment: reflectance of hair without pigment, minus kSurface. (As a coefficient of
  //   the fit, it may exceed 1.)
  // - kEumelanin, kPheomelanin: absorption per unit of pigment concentration.
  // - kWhite: reflectance of white hair.
  constexpr std::array<double, 3> kWithoutPigment = {1.1, 0.78, 0.33};
  constexpr std::array<double, 3> kEumelanin = {5.3, 5.7, 5.2}, kPheomelanin = {0.5, 1.6, 2.8};
  constexpr std::array<double, 3> kWhite = {0.375, 0.352, 0.322};
  constexpr double kSurface = 0.009;
  std::array<float, 3> light{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double absorbed = kEumelanin[c] * colour.eumelanin + kPheomelanin[c] * colour.pheomelanin;
    const double pigmented = kSurface + kWithoutPigment[c] * std::exp(-absorbed);
    light[c] = static_cast<float>(std::min(
        double{kNeutralTextureMean}, pigmented + colour.grey_fraction * (kWhite[c] - pigmented)));
  }
  return light;
}

std::array<float, 3> tint_factors(const HairColour& colour) {
  std::array<float, 3> factors = reflected_light(colour);
  for (float& factor : factors) factor /= kNeutralTextureMean;
  return factors;
}

}  // namespace crowdface
