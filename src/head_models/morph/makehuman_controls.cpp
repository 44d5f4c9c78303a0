// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/makehuman_controls.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

// Ages in years at which MakeHuman's young and old targets apply fully.
constexpr double kYoung = 25, kOld = 80;
constexpr double kUnaged = 33;  // age in years at which `Control::aged` changes nothing
constexpr std::array<std::string_view, 3> kAmounts = {"min", "average", "max"};

/// A random measure of the face, from −1 to 1. Negative values use the morph target stem + less,
/// positive values use stem + more. '*' in `stem` stands for l and r (left and right), whose values
/// differ slightly. The measure is normally distributed. Its mean is the sum of `mean` and the
/// changes by age, body weight and sex.
struct Control {
  std::string_view stem, less, more;
  double spread;    ///< standard deviation of the measure
  double aged = 0;  ///< change of the measure's mean per 20 years of age above kUnaged
  /// Change of the measure's mean for people with the largest body weight, compared with people of
  /// average body weight. For people with the smallest body weight, the change is −`weight`.
  double weight = 0;
  /// Change of the measure's mean for women, compared with men. MakeHuman's own targets for sex are
  /// not enough: with these targets only, many women have the face of a man.
  double female = 0;
  double mean = 0;  ///< mean of the measure for men of age kUnaged with average body weight
};

// clang-format off
constexpr Control kControls[] = {
    {"head/head-", "scale-horiz-less", "scale-horiz-more", 0.099},
    {"head/head-", "scale-vert-less", "scale-vert-more", 0.063},
    {"head/head-", "scale-depth-less", "scale-depth-more", 0.113},
    {"head/head-", "back-scale-depth-less", "back-scale-depth-more", 0.09},
    {"head/head-", "angle-in", "angle-out", 0.0675},
    {"head/head-", "skinny", "fat", 0.135, 0, 0.5},
    {"head/head-", "age-less", "age-more", 0.113, 0.35},
    {"head/head-", "oval", "square", 0.158, 0, 0, -0.2},
    {"head/head-", "invertedtriangular", "triangular", 0.158},
    {"head/head-", "rectangular", "round", 0.135, 0, 0.2},
    {"forehead/forehead-", "nubian-less", "nubian-more", 0.03},
    {"forehead/forehead-", "scale-vert-less", "scale-vert-more", 0.1},
    {"forehead/forehead-", "temple-in", "temple-out", 0.225},
    {"forehead/forehead-", "trans-depth-backward", "trans-depth-forward", 0.15},
    {"eyebrows/eyebrows-", "angle-down", "angle-up", 0.21, 0.1, 0, 0, 0.4},
    {"eyebrows/eyebrows-", "trans-depth-less", "trans-depth-more", 0.15, 0, 0, -0.7},
    {"eyebrows/eyebrows-", "trans-vert-less", "trans-vert-more", 0.24, 0, 0, 0.45, 0.1},
    {"eyes/*-eye-", "bag-min", "bag-max", 0.21, 0.35},
    {"eyes/*-eye-", "bag-in", "bag-out", 0.21, 0.2},
    {"eyes/*-eye-", "bag-height-min", "bag-height-max", 0.18},
    {"eyes/*-eye-", "corner1-down", "corner1-up", 0.27},
    {"eyes/*-eye-", "corner2-down", "corner2-up", 0.27, -0.05},
    {"eyes/*-eye-", "epicanthus-in", "epicanthus-out", 0.15},
    {"eyes/*-eye-", "eyefold-angle-down", "eyefold-angle-up", 0.24},
    {"eyes/*-eye-", "eyefold-concave", "eyefold-convex", 0.18},
    {"eyes/*-eye-", "eyefold-down", "eyefold-up", 0.21, -0.1},
    {"eyes/*-eye-", "height1-min", "height1-max", 0.21},
    {"eyes/*-eye-", "height2-min", "height2-max", 0.24, -0.1, 0, 0.1},
    {"eyes/*-eye-", "height3-min", "height3-max", 0.21},
    {"eyes/*-eye-", "move-in", "move-out", 0.24},
    {"eyes/*-eye-", "move-down", "move-up", 0.15},
    {"eyes/*-eye-", "push1-in", "push1-out", 0.18},
    {"eyes/*-eye-", "push2-in", "push2-out", 0.18},
    {"eyes/*-eye-", "size-small", "size-big", 0.27, 0, 0, 0.3},
    {"nose/nose-", "compression-uncompress", "compression-compress", 0.15},
    {"nose/nose-", "curve-concave", "curve-convex", 0.24},
    {"nose/nose-", "flaring-decr", "flaring-incr", 0.24},
    {"nose/nose-", "greek-lessgreek", "greek-moregreek", 0.27},
    {"nose/nose-", "height-min", "height-max", 0.18},
    {"nose/nose-", "hump-lesshump", "hump-morehump", 0.27, 0, 0, -0.35},
    {"nose/nose-", "nostril-width-min", "nostril-width-max", 0.24},
    {"nose/nose-", "nostrils-angle-down", "nostrils-angle-up", 0.21},
    {"nose/nose-", "point-up", "point-down", 0.08, 0.05},
    {"nose/nose-", "point-width-less", "point-width-more", 0.27, 0.1},
    {"nose/nose-", "scale-depth-decr", "scale-depth-incr", 0.12},
    {"nose/nose-", "scale-horiz-decr", "scale-horiz-incr", 0.24, 0.1, 0, -0.35},
    {"nose/nose-", "scale-vert-decr", "scale-vert-incr", 0.21, 0.15, 0, -0.22},
    {"nose/nose-", "septumangle-decr", "septumangle-incr", 0.12},
    {"nose/nose-", "trans-vert-up", "trans-vert-down", 0.18},
    {"nose/nose-", "volume-point", "volume-potato", 0.14, 0.1, 0, -0.2},
    {"nose/nose-", "width1-min", "width1-max", 0.24, 0, 0, -0.2},
    {"nose/nose-", "width2-min", "width2-max", 0.24},
    {"nose/nose-", "width3-min", "width3-max", 0.24},
    {"mouth/mouth-", "angles-down", "angles-up", 0.15, 0.1, 0, 0, 0.4},
    {"mouth/mouth-", "cupidsbow-decr", "cupidsbow-incr", 0.27, -0.1},
    {"mouth/mouth-", "cupidsbow-width-min", "cupidsbow-width-max", 0.24},
    {"mouth/mouth-", "laugh-lines-out", "laugh-lines-in", 0.18, 0.35},
    {"mouth/mouth-", "lowerlip-ext-down", "lowerlip-ext-up", 0.18},
    {"mouth/mouth-", "lowerlip-height-min", "lowerlip-height-max", 0.18, -0.12},
    {"mouth/mouth-", "lowerlip-middle-down", "lowerlip-middle-up", 0.15},
    {"mouth/mouth-", "lowerlip-volume-deflate", "lowerlip-volume-inflate", 0.2, -0.25, 0, 0.25},
    {"mouth/mouth-", "lowerlip-width-min", "lowerlip-width-max", 0.18},
    {"mouth/mouth-", "philtrum-volume-decrease", "philtrum-volume-increase", 0.24},
    {"mouth/mouth-", "scale-depth-decr", "scale-depth-incr", 0.21},
    {"mouth/mouth-", "scale-horiz-decr", "scale-horiz-incr", 0.18},
    {"mouth/mouth-", "scale-vert-decr", "scale-vert-incr", 0.21, -0.15},
    {"mouth/mouth-", "trans-up", "trans-down", 0.15},
    {"mouth/mouth-", "trans-backward", "trans-forward", 0.1},
    {"mouth/mouth-", "upperlip-height-min", "upperlip-height-max", 0.21, -0.2, 0, 0.3},
    {"mouth/mouth-", "upperlip-middle-down", "upperlip-middle-up", 0.15},
    {"mouth/mouth-", "upperlip-volume-deflate", "upperlip-volume-inflate", 0.2, -0.25, 0, 0.25},
    {"mouth/mouth-", "upperlip-width-min", "upperlip-width-max", 0.18},
    {"chin/chin-", "bones-in", "bones-out", 0.18, 0, 0, -0.2},
    {"chin/chin-", "cleft-out", "cleft-in", 0.21},
    {"chin/chin-", "height-min", "height-max", 0.168, 0, 0, -0.2},
    {"chin/chin-", "jaw-drop-less", "jaw-drop-more", 0.21, 0.15, 0, -0.4},
    {"chin/chin-", "prognathism-less", "prognathism-more", 0.18},
    {"chin/chin-", "prominent-less", "prominent-more", 0.21, 0, 0, -0.15},
    {"chin/chin-", "width-min", "width-max", 0.24, 0, 0, -0.5},
    {"cheek/*-cheek-", "bones-in", "bones-out", 0.24, 0, 0, 0.15},
    {"cheek/*-cheek-", "inner-deflate", "inner-inflate", 0.21, -0.1},
    {"cheek/*-cheek-", "trans-vert-down", "trans-vert-up", 0.18, -0.15},
    {"cheek/*-cheek-", "volume-deflate", "volume-inflate", 0.21, -0.2, 0.3},
    {"ears/*-ear-", "flap-in", "flap-out", 0.175},
    {"ears/*-ear-", "height-min", "height-max", 0.21, 0.15},
    {"ears/*-ear-", "lobe-min", "lobe-max", 0.245, 0.15},
    {"ears/*-ear-", "rot-backward", "rot-forward", 0.21},
    {"ears/*-ear-", "shape1-triangle", "shape1-pointed", 0.07},
    {"ears/*-ear-", "shape2-square", "shape2-round", 0.245},
    {"ears/*-ear-", "size-small", "size-big", 0.21, 0.1},
    {"ears/*-ear-", "trans-vert-down", "trans-vert-up", 0.105},
    {"ears/*-ear-", "width-min", "width-max", 0.245},
    {"ears/*-ear-", "wing-in", "wing-out", 0.245},
    {"neck/neck-", "double-less", "double-more", 0.175, 0.15, 0.5},
    {"neck/neck-", "scale-horiz-less", "scale-horiz-more", 0.175, 0, 0.2, -0.1},
    {"neck/neck-", "scale-depth-less", "scale-depth-more", 0.14, 0, 0.2, -0.1},
    {"asym/asym-", "brown-1-l", "brown-1-r", 0.2},
    {"asym/asym-", "brown-2-l", "brown-2-r", 0.2},
    {"asym/asym-", "cheek-1-l", "cheek-1-r", 0.2},
    {"asym/asym-", "eye-1-l", "eye-1-r", 0.2},
    {"asym/asym-", "eye-3-l", "eye-3-r", 0.2},
    {"asym/asym-", "eye-5-l", "eye-5-r", 0.2},
    {"asym/asym-", "jaw-1-l", "jaw-1-r", 0.25},
    {"asym/asym-", "jaw-2-l", "jaw-2-r", 0.2},
    {"asym/asym-", "mouth-1-l", "mouth-1-r", 0.25},
    {"asym/asym-", "mouth-2-l", "mouth-2-r", 0.2},
    {"asym/asym-", "nose-1-l", "nose-1-r", 0.25},
    {"asym/asym-", "nose-3-l", "nose-3-r", 0.2},
    {"asym/asym-", "ear-1-l", "ear-1-r", 0.2},
    {"asym/asym-", "temple-1-l", "temple-1-r", 0.2},
};
// clang-format on

std::string target_name(const Control& control, std::string_view end, char side) {
  std::string name = concat(control.stem, end);
  const std::size_t star = name.find('*');
  if (star != std::string::npos) name[star] = side;
  return name;
}

std::span<const char> sides_of(const Control& control) {
  static constexpr std::array<char, 2> kSides = {'l', 'r'};
  const bool paired = control.stem.find('*') != std::string_view::npos;
  return std::span(kSides).first(paired ? 2 : 1);
}

/// Returns the weights with which the targets for the minimum, the average and the maximum of an
/// attribute, such as muscle, are interpolated. x is the attribute's value, 0 … 1.
std::array<double, 3> amount_weights(double x) {
  return {std::max(0.0, 1 - 2 * x), 1 - std::abs(2 * x - 1), std::max(0.0, 2 * x - 1)};
}

/// Adds the person's targets with the weights that MakeHuman uses: linear interpolation between the
/// targets of both sexes, two ages and three builds.
void add_person(const MakeHumanPerson& person, double male_share, std::vector<TargetWeight>& out) {
  const double old_share = std::clamp((person.age_years - kYoung) / (kOld - kYoung), 0.0, 1.0);
  const auto muscle = amount_weights(person.muscle), weight = amount_weights(person.weight);
  for (const bool male : {false, true}) {
    for (const bool old : {false, true}) {
      const double share = (male ? male_share : 1 - male_share) * (old ? old_share : 1 - old_share);
      const std::string who = concat(male ? "male-" : "female-", old ? "old" : "young");
      for (std::size_t a = 0; a < 3; ++a) {
        out.push_back(
            {concat("macrodetails/", kAncestries[a], "-", who), share * person.ancestry[a]});
        for (std::size_t w = 0; w < 3; ++w) {
          out.push_back({concat("macrodetails/universal-", who, "-", kAmounts[a], "muscle-",
                                kAmounts[w], "weight"),
                         share * muscle[a] * weight[w]});
        }
      }
    }
  }
}

}  // namespace

MakeHumanPerson random_makehuman_person(std::uint64_t seed, std::uint64_t index) {
  MakeHumanPerson person;
  // Use stratified random numbers, so that even a few heads include both sexes and several ages.
  person.is_male = random_stratified({seed, index, "makehuman/sex"}, 2) < 0.5;
  person.age_years = std::floor(20 + 60 * random_stratified({seed, index, "makehuman/age"}, 5));
  double sum = 0;
  for (std::uint32_t a = 0; a < 3; ++a) {
    // The fourth power gives most people one dominant ancestry.
    const double x = 0.02 + random_uniform({seed, index, "makehuman/ancestry"}, a);
    person.ancestry[a] = x * x * x * x;
    sum += person.ancestry[a];
  }
  for (double& share : person.ancestry) share /= sum;
  const auto amount = [&](std::string_view purpose, double mean) {
    return std::clamp(mean + 0.17 * random_normal({seed, index, purpose}), 0.1, 0.9);
  };
  person.muscle = amount("makehuman/muscle", person.is_male ? 0.6 : 0.4);
  person.weight = amount("makehuman/weight", 0.5);
  return person;
}

std::vector<TargetWeight> makehuman_targets(const MakeHumanPerson& person, std::uint64_t seed,
                                            std::uint64_t index) {
  std::vector<TargetWeight> out;
  // Weight of the other sex's targets: from −40 % to −10 %, which exaggerates the person's own sex.
  const double mixed = random_between({seed, index, "makehuman/sex_share"}, -0.4, -0.1);
  add_person(person, person.is_male ? 1 - mixed : mixed, out);
  for (const Control& control : kControls) {
    const std::string purpose = concat("makehuman/", control.stem, control.more);
    const double both = control.spread * random_normal({seed, index, purpose}) +
                        control.aged * (person.age_years - kUnaged) / 20 +
                        control.weight * (2 * person.weight - 1) + control.mean +
                        (person.is_male ? 0 : control.female);
    for (const char side : sides_of(control)) {
      const std::string own = concat(purpose, "/", side);
      const double uneven = sides_of(control).size() > 1 ? 0.25 * control.spread : 0;
      const double value = std::clamp(both + uneven * random_normal({seed, index, own}), -1.0, 1.0);
      out.push_back(
          {target_name(control, value < 0 ? control.less : control.more, side), std::abs(value)});
    }
  }
  std::erase_if(out, [](const TargetWeight& target) { return target.weight == 0; });
  return out;
}

std::vector<std::string> makehuman_target_names() {
  std::vector<TargetWeight> persons;
  add_person({false, kYoung, {}, 0, 0}, 0, persons);
  std::vector<std::string> names;
  for (const TargetWeight& target : persons) names.push_back(target.target);
  for (const Control& control : kControls) {
    for (const char side : sides_of(control)) {
      names.push_back(target_name(control, control.less, side));
      names.push_back(target_name(control, control.more, side));
    }
  }
  return names;
}

}  // namespace crowdface
