// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/child_skin_colours.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// The range of a child's tone, as fractions of the way from the lighter to the darker parent.
constexpr double kLightest = 0.3, kDarkest = 0.7;

/// Returns how much the skins of two heads differ in sex and age: the number of tags of sex and age
/// that only one of the two heads has. 0 if `tags` is empty.
int differing_tag_count(Index a, Index b, const HeadTags& tags) {
  int count = 0;
  if (tags.empty()) return count;
  for (const std::string_view tag : {"female", "male", "young", "adult", "old"}) {
    count += contains(tags[static_cast<std::size_t>(a)], tag) !=
             contains(tags[static_cast<std::size_t>(b)], tag);
  }
  return count;
}

/// Returns a mixture of two heads with the given tone. A tone outside the range of the heads' tones
/// is first clamped to this range. Of all such mixtures, chooses the mixture whose heads differ
/// least in sex and age from the head `like` (weighted mean of differing_tag_count). If several
/// mixtures differ equally, chooses the two heads whose tones are closest to each other.
std::vector<SourceWeight> mixture_of_tone(double tone, Index like,
                                          const ChildSkinOptions& options) {
  const auto [lightest, darkest] = std::ranges::minmax(options.tones);
  tone = std::clamp(tone, lightest, darkest);
  const auto tone_of = [&](Index head) { return options.tones[static_cast<std::size_t>(head)]; };
  std::vector<int> differences;
  const auto count = static_cast<Index>(options.tones.size());
  for (Index h = 0; h < count; ++h)
    differences.push_back(differing_tag_count(h, like, options.tags));
  std::vector<SourceWeight> best;
  std::pair<double, double> best_cost;
  for (Index light = 0; light < count; ++light) {
    if (tone_of(light) > tone) continue;
    for (Index dark = 0; dark < count; ++dark) {
      const double width = tone_of(dark) - tone_of(light);
      if (tone_of(dark) < tone) continue;
      const double share = width > 0 ? (tone - tone_of(light)) / width : 0;
      const std::pair cost((1 - share) * differences[static_cast<std::size_t>(light)] +
                               share * differences[static_cast<std::size_t>(dark)],
                           width);
      if (!best.empty() && cost >= best_cost) continue;
      best_cost = cost;
      best = {{light, 1 - share}, {dark, share}};
    }
  }
  return normalized_weights(best);
}

}  // namespace

void choose_skin_colours_of_children(const ChildSkinOptions& draw, std::vector<FacePlan>& crowd) {
  std::map<std::string, double> tones;  // tones of heads and faces, by name
  for (std::size_t h = 0; h < draw.head_names.size(); ++h)
    tones[draw.head_names[h]] = draw.tones[h];
  std::map<std::string, bool> is_parent;
  for (const FacePlan& face : crowd) {
    for (const std::string& parent : face.parents) is_parent[parent] = true;
  }
  const auto tone_of = [&](const Recipe& recipe) {
    const std::vector<double> shares = draw.colour_weights(recipe);
    return std::inner_product(shares.begin(), shares.end(), draw.tones.begin(), 0.0);
  };
  for (FacePlan& face : crowd) {
    const bool known =
        !face.parents.empty() && std::ranges::all_of(face.parents, [&](const std::string& parent) {
          return tones.contains(parent);
        });
    if (known) {
      const std::string purpose =
          concat("skin/",
                 face.family && draw.twin_families.contains(*face.family) ? *face.family : face.id);
      const double lighter = std::min(tones[face.parents[0]], tones[face.parents[1]]);
      const double darker = std::max(tones[face.parents[0]], tones[face.parents[1]]);
      const auto at = [&](double share) { return lighter + share * (darker - lighter); };
      const double own = tone_of(face.recipe);
      if (face.recipe.colours.empty() || own < at(kLightest) || own > at(kDarkest)) {
        const double tone = at(random_between({draw.seed, 0, purpose}, kLightest, kDarkest));
        face.recipe.colours = mixture_of_tone(tone, typical_head(face.recipe, draw.tags), draw);
      }
    }
    if (is_parent.contains(face.id)) tones[face.id] = tone_of(face.recipe);
  }
}

}  // namespace crowdface
