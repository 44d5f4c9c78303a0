// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/sheet_labels.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string_view>

#include "crowdface/cast/typical_head.h"
#include "crowdface/core/require.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// The name of the target head, such as "ann". If the target is a mixture of heads, the names and
/// weights, such as "ann 60 %, bob 40 %".
std::string target_label(const Recipe& recipe, const std::vector<std::string>& heads) {
  if (recipe.mixture.empty()) return heads[static_cast<std::size_t>(recipe.target)];
  std::vector<std::string> parts;
  for (const SourceWeight& part : recipe.mixture) {
    parts.push_back(concat(heads[static_cast<std::size_t>(part.head)], ' ',
                           std::lround(100 * part.weight), " %"));
  }
  return join(parts);
}

/// The names of the regions that the face inherits from `parent`. If only some bands of detail of a
/// region come from this parent, the list has an entry "region/band" for each of these bands.
/// Example: "brow/skin" for the band `skin` of the region `brow`.
std::vector<std::string> inherited_regions(std::string_view parent, const FacePlan& face,
                                           const PlanNames& names) {
  const std::size_t bands = std::max(names.bands.size(), std::size_t{1});
  require(face.inherited_from.size() == names.regions.size() * bands, "a child of ",
          face.inherited_from.size(), " parts where there are ", names.regions.size(),
          " regions of ", bands);
  std::vector<std::string> given;
  for (std::size_t k = 0; k < names.regions.size(); ++k) {
    const std::span own = std::span(face.inherited_from).subspan(k * bands, bands);
    if (std::ranges::all_of(own, [&](const auto& by) { return by == parent; })) {
      given.push_back(names.regions[k]);
      continue;
    }
    for (std::size_t b = 0; b < names.bands.size(); ++b) {
      if (own[b] == parent) given.push_back(concat(names.regions[k], '/', names.bands[b]));
    }
  }
  return given;
}

}  // namespace

std::vector<std::size_t> sheet_order(SheetOrder order, const std::vector<FacePlan>& crowd,
                                     const Likeness& likeness) {
  if (order == SheetOrder::kLikeness) return likeness.face_order;
  std::vector<std::size_t> faces(crowd.size());
  std::iota(faces.begin(), faces.end(), std::size_t{0});
  if (order == SheetOrder::kPlan) return faces;
  const auto kin = order == SheetOrder::kFamily ? &FacePlan::family : &FacePlan::group;
  std::stable_sort(faces.begin(), faces.end(), [&](std::size_t a, std::size_t b) {
    const auto& left = crowd[a].*kin;
    const auto& right = crowd[b].*kin;
    return left && (!right || *left < *right);  // faces without a family or group come last
  });
  return faces;
}

std::string sheet_label(const std::vector<SheetLabel>& labels, const std::vector<FacePlan>& crowd,
                        std::size_t face, const Likeness& likeness,
                        const std::vector<std::string>& heads,
                        const std::vector<std::vector<std::string>>& tags) {
  const FacePlan& labelled = crowd[face];
  const auto line = [&](SheetLabel label) -> std::string {
    switch (label) {
      case SheetLabel::kId:
        return labelled.id;
      case SheetLabel::kFamily:
        return labelled.family ? concat("family ", *labelled.family) : std::string();
      case SheetLabel::kGroup:
        return labelled.group ? concat("group ", *labelled.group) : std::string();
      case SheetLabel::kTarget:
        return concat("on ", target_label(labelled.recipe, heads));
      case SheetLabel::kNearest: {
        if (likeness.neighbours[face].empty()) return {};
        const Neighbour& near = likeness.neighbours[face].front();
        return concat("near ", crowd[near.face].id, ", ",
                      format_fixed(rounded(near.distance_mm), 2), " mm");
      }
      case SheetLabel::kNearestHead:
        if (!labelled.notes.nearest) return {};
        return concat("near ", heads[static_cast<std::size_t>(labelled.notes.nearest->head)], ", ",
                      format_fixed(rounded(labelled.notes.nearest->head_distance_mm), 2), " mm");
      case SheetLabel::kTags:
        return join(tags[static_cast<std::size_t>(typical_head(labelled.recipe, tags))]);
      case SheetLabel::kAttachments:
        return join(labelled.attachments);
    }
    return {};
  };
  std::vector<std::string> lines;
  for (const SheetLabel label : labels) lines.push_back(line(label));
  return join(lines, "\n");
}

std::string inheritance_label(const FacePlan& face, const PlanNames& names) {
  std::string label = face.id;
  if (face.mother_share > 0) {
    label += concat("\nform ", std::lround(100 * face.mother_share), " % mother");
  }
  if (face.inherited_from.empty()) return label;
  for (const std::string_view parent : {"mother", "father"}) {
    const std::vector<std::string> given = inherited_regions(parent, face, names);
    if (!given.empty()) label += concat("\n", parent, ": ", join(given));
  }
  return label;
}

}  // namespace crowdface
