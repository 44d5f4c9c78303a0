// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/hair_chooser.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "crowdface/cast/shares.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/random.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

HairColour mix(const HairColour& a, const HairColour& b, double share) {
  return {a.eumelanin + share * (b.eumelanin - a.eumelanin),
          a.pheomelanin + share * (b.pheomelanin - a.pheomelanin),
          a.grey_fraction + share * (b.grey_fraction - a.grey_fraction)};
}

/// Chooses an index at random; `shares` are the probabilities of the indices. Returns −1 if the
/// random number `drawn` (0 … 1) exceeds the sum of the shares.
int random_index(const std::vector<double>& shares, double drawn) {
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (drawn < shares[i]) return static_cast<int>(i);
    drawn -= shares[i];
  }
  return -1;
}

/// Converts an age in years to the scale of HairChooser::apparent_age.
double apparent_age_of(double years) {
  constexpr double kYoungYears = 25, kOldYears = 66, kYoung = 0.15, kOld = 0.85;
  return std::clamp(kYoung + (years - kYoungYears) * (kOld - kYoung) / (kOldYears - kYoungYears),
                    kYoung, 1.0);
}

}  // namespace

HairChooser::HairChooser(HairOptions options, const std::vector<FacePlan>& crowd)
    : options_(std::move(options)) {
  const auto is_empty = [](const auto& entry) { return entry.second.empty(); };
  if (std::ranges::all_of(options_.hair_colours, is_empty)) return;
  std::set<std::string> families;
  for (const FacePlan& face : crowd) {
    if (!face.parents.empty() || (face.family && !families.insert(*face.family).second)) continue;
    const std::string entry = key_in_hair_colours(face);
    entries_of_faces_[face.id] = {entry, entry_sizes_[entry]++};
  }
}

HairColour HairChooser::colour_of(const FacePlan& face, Index head) {
  const bool is_twin = face.family && options_.twin_families.contains(*face.family);
  const std::string person = is_twin ? *face.family : face.index ? std::string() : face.id;
  const auto key = [&](const char* what) {
    return person.empty() ? std::string(what) : concat(what, '/', person);
  };
  std::optional<HairColour> colour = inherited_colour(face, person);
  const double grey = grey_fraction(face, key("hair/grey"));
  if (!colour) colour = configured_colour(face, looks_grey({0, 0, grey}));
  if (!colour) colour = colour_of_tags(head, key("hair/tone"));
  if (face.family && face.parents.empty()) family_colours_.try_emplace(*face.family, *colour);
  // Vary the colours slightly at random, so that not all brown hair has the same shade of brown.
  const std::string purpose = key("hair/scatter");
  const auto scatter = random_pair({options_.seed, is_twin ? 0 : face.index.value_or(0), purpose});
  constexpr double kScatter = 0.1;
  HairColour own = *colour;
  own.eumelanin += kScatter * own.eumelanin * (scatter[0] - 0.5);
  own.pheomelanin += kScatter * (scatter[1] - 0.5);
  base_colours_[face.id] = own;
  own.grey_fraction = std::max(own.grey_fraction, grey);
  return rounded_colour(own);
}

std::string HairChooser::key_in_hair_colours(const FacePlan& face) const {
  const std::string group = face.group.value_or("");
  return options_.hair_colours.contains(group) ? group : "";
}

std::optional<HairColour> HairChooser::configured_colour(const FacePlan& face, bool is_grey) {
  const std::string entry = key_in_hair_colours(face);
  const auto shares = options_.hair_colours.find(entry);
  if (shares == options_.hair_colours.end() || shares->second.empty()) return std::nullopt;
  std::vector<double> parts;
  std::vector<HairColour> colours;
  for (const auto& [name, share] : shares->second) {
    parts.push_back(share);
    colours.push_back(*hair_colour_named(name));
  }
  int chosen = -1;
  const auto place = entries_of_faces_.find(face.id);
  if (place != entries_of_faces_.end() && place->second.key == entry) {
    const auto [schedule, is_new] = colour_indices_.try_emplace(entry);
    if (is_new) {
      schedule->second = schedule_shares_randomly(parts, entry_sizes_[entry], options_.seed,
                                                  concat("hair colours/", entry));
    }
    chosen = schedule->second[place->second.face_index];
    // A redrawn face keeps the colour that the rejected face had.
    const auto [own, is_first] = colour_of_faces_.try_emplace(face.id, chosen);
    std::deque<int>& hidden = hidden_colours_[entry];
    if (is_first && is_grey && chosen >= 0 &&
        colours[static_cast<std::size_t>(chosen)].grey_fraction == 0) {
      hidden.push_back(chosen);
    } else if (is_first && !is_grey && chosen < 0 && !hidden.empty()) {
      own->second = hidden.front();
      hidden.pop_front();
    }
    chosen = own->second;
  } else {
    const std::string purpose = concat("hair/colour/", face.id);
    chosen = random_index(parts, random_uniform({options_.seed, face.index.value_or(0), purpose}));
  }
  return chosen < 0 ? std::nullopt : std::optional(colours[static_cast<std::size_t>(chosen)]);
}

std::optional<HairColour> HairChooser::inherited_colour(const FacePlan& face,
                                                        const std::string& person) const {
  if (face.parents.empty()) {
    const auto found = face.family ? family_colours_.find(*face.family) : family_colours_.end();
    return found == family_colours_.end() ? std::nullopt : std::optional(found->second);
  }
  std::vector<HairColour> known;
  for (const std::string& parent : face.parents) {
    if (const auto colour = colour_of_parent(parent)) known.push_back(*colour);
  }
  if (known.empty()) return std::nullopt;
  if (known.size() == 1) return known[0];
  // The child has the colour of one parent (with a probability of 35 % for each parent) or a colour
  // between the two.
  const std::string purpose = concat("hair/parent/", person);
  const auto drawn = random_pair({options_.seed, 0, purpose});
  const double share = drawn[0] < 0.35 ? 0.0 : drawn[0] < 0.7 ? 1.0 : 0.3 + 0.4 * drawn[1];
  return mix(known[0], known[1], share);
}

std::optional<HairColour> HairChooser::colour_of_parent(const std::string& parent) const {
  if (const auto face = base_colours_.find(parent); face != base_colours_.end())
    return face->second;
  const auto head = std::ranges::find(options_.head_names, parent);
  if (head == options_.head_names.end()) return std::nullopt;
  return colour_of_tags(head - options_.head_names.begin(), concat("hair/tone/", parent));
}

HairColour HairChooser::colour_of_tags(Index head, const std::string& random_number_purpose) const {
  constexpr std::string_view kEnding = "_hair";
  for (const std::string& tag : options_.tags[static_cast<std::size_t>(head)]) {
    if (!tag.ends_with(kEnding)) continue;
    const auto colour =
        hair_colour_named(std::string_view(tag).substr(0, tag.size() - kEnding.size()));
    if (colour) return *colour;
  }
  const double drawn =
      random_uniform({options_.seed, static_cast<std::uint64_t>(head), random_number_purpose});
  return *hair_colour_named(drawn < 0.4 ? "black" : drawn < 0.75 ? "dark_brown" : "brown");
}

double HairChooser::mean_age_of_heads(const Recipe& recipe) const {
  const auto of_head = [&](Index head) {
    const std::vector<std::string>& tags = options_.tags[static_cast<std::size_t>(head)];
    return contains(tags, "old")     ? 0.88
           : contains(tags, "adult") ? 0.45
           : contains(tags, "young") ? 0.15
                                     : 0.3;
  };
  double of_target = 0, detail = 0, detail_weight = 0;
  for (const SourceWeight& one : target_head_weights(recipe)) {
    of_target += one.weight * of_head(one.head);
  }
  for (const RegionRecipe& region : recipe.regions) {
    for (const SourceWeight& one : band_of(region, band_count(region) - 1).weights) {
      detail += one.weight * of_head(one.head);
      detail_weight += one.weight;
    }
  }
  constexpr double kTarget = 0.75;
  return detail_weight > 0 ? kTarget * of_target + (1 - kTarget) * detail / detail_weight
                           : of_target;
}

double HairChooser::apparent_age(const FacePlan& face) const {
  if (face.age_years) return apparent_age_of(*face.age_years);
  const double of_heads = mean_age_of_heads(face.recipe);
  // FacePlan::age ranges from −1 (young) to 1 (old). The apparent age lies between the mean age of
  // the heads and the apparent age of an old or young person; `way` is the fraction of the way to
  // the old or young person. Because of the square root, grey hair is visible at a FacePlan::age of
  // 0.5 already.
  const double age = face.age.value_or(0);
  const double way = std::sqrt(std::min(1.0, std::abs(age)));
  return of_heads + way * ((age < 0 ? 0.15 : std::max(0.9, of_heads)) - of_heads);
}

double HairChooser::grey_fraction(const FacePlan& face,
                                  const std::string& random_number_purpose) const {
  // Each person's hair begins to turn grey at a random age, but never while the person is young.
  const double begin =
      random_uniform({options_.seed, face.index.value_or(0), random_number_purpose}) - 0.5;
  return smooth_step(0.5, 1.0, apparent_age(face) + 0.2 * begin);
}

}  // namespace crowdface
