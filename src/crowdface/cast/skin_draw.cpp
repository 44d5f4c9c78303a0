// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/skin_draw.h"

#include <algorithm>
#include <map>
#include <optional>

#include "crowdface/core/contains.h"
#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// Returns the heads that have the same sex and the same age class as the given head.
std::vector<Index> heads_like(Index head, const HeadTags& tags) {
  std::vector<Index> heads;
  for (Index h = 0; h < static_cast<Index>(tags.size()); ++h) {
    const bool same =
        std::ranges::all_of(std::vector<std::string>{"female", "male", "young", "adult", "old"},
                            [&](const std::string& tag) {
                              return contains(tags[static_cast<std::size_t>(h)], tag) ==
                                     contains(tags[static_cast<std::size_t>(head)], tag);
                            });
    if (same) heads.push_back(h);
  }
  return heads;
}

/// Returns a mixture of two of the heads that has the given tone. If all heads are lighter or all
/// are darker, returns the head with the nearest tone alone.
std::vector<SourceWeight> mixture_of_tone(double tone, const std::vector<Index>& heads,
                                          const std::vector<double>& tones) {
  const auto tone_of = [&](Index head) { return tones[static_cast<std::size_t>(head)]; };
  std::optional<Index> lighter, darker;
  for (const Index head : heads) {
    const double own = tone_of(head);
    if (own <= tone && (!lighter || own > tone_of(*lighter))) lighter = head;
    if (own >= tone && (!darker || own < tone_of(*darker))) darker = head;
  }
  if (!lighter || !darker || tone_of(*darker) == tone_of(*lighter)) {
    return {{lighter ? *lighter : *darker, 1}};
  }
  const double share = (tone - tone_of(*lighter)) / (tone_of(*darker) - tone_of(*lighter));
  return normalized_weights({{*lighter, 1 - share}, {*darker, share}});
}

}  // namespace

void choose_skin_colours_of_children(const SkinOptions& draw, std::vector<FacePlan>& crowd) {
  std::map<std::string, double> tones;  // tones of heads and faces, by name
  for (std::size_t h = 0; h < draw.head_names.size(); ++h)
    tones[draw.head_names[h]] = draw.tones[h];
  std::map<std::string, bool> is_parent;
  for (const FacePlan& face : crowd) {
    for (const std::string& parent : face.parents) is_parent[parent] = true;
  }
  const auto meet = [&](const FacePlan& face) {
    if (!is_parent.contains(face.id)) return;
    const std::vector<double> shares = draw.colour_weights(face.recipe);
    double tone = 0;
    for (std::size_t h = 0; h < shares.size(); ++h) tone += shares[h] * draw.tones[h];
    tones[face.id] = tone;
  };
  for (FacePlan& face : crowd) {
    const bool known =
        !face.parents.empty() && std::ranges::all_of(face.parents, [&](const std::string& parent) {
          return tones.contains(parent);
        });
    if (known && face.recipe.colours.empty()) {
      const std::string purpose =
          concat("skin/",
                 face.family && draw.twin_families.contains(*face.family) ? *face.family : face.id);
      const double place = random_between({draw.seed, 0, purpose}, 0.2, 0.8);
      const double mother = tones[face.parents[0]], father = tones[face.parents[1]];
      face.recipe.colours =
          mixture_of_tone(mother + place * (father - mother),
                          heads_like(typical_head(face.recipe, draw.tags), draw.tags), draw.tones);
    }
    meet(face);
  }
}

}  // namespace crowdface
