// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/gap_preserver.h"

#include <algorithm>
#include <cmath>

#include "crowdface/parts/component_shape.h"

namespace crowdface {
namespace {

/// A gap counts as nearly unchanged by a shape (GapSelection::kNearlyUnchanged) if the shape
/// changes the gap's width by at most this fraction of the skin's extent (0.4 mm on a head).
constexpr double kMaxChange = 1e-3;

}  // namespace

GapPreserver::GapPreserver(const HeadSet& head_set, const Adjacency& adjacency,
                           std::span<const std::uint32_t> skin)
    : contacts_(head_set, adjacency, skin),
      max_gap_change_(kMaxChange * extent_of(head_set.heads.front().positions, skin)) {}

bool GapPreserver::is_affected_by(std::span<const std::uint32_t> vertices) const {
  for (std::size_t p = 0; p < contacts_.size(); ++p) {
    for (const auto* profile :
         {&contacts_.section(p).low_profile, &contacts_.section(p).high_profile}) {
      for (const EdgePoint& point : *profile) {
        if (std::ranges::binary_search(vertices, point.a)) return true;
      }
    }
  }
  return false;
}

std::vector<std::uint32_t> GapPreserver::contact_vertices() const {
  std::vector<std::uint32_t> vertices;
  for (std::size_t p = 0; p < contacts_.size(); ++p) {
    vertices.push_back(contacts_.section(p).low_profile.front().a);
  }
  return vertices;
}

double GapPreserver::max_overlap(const Positions& positions) const {
  double deepest = 0;
  for (const double gap : measure_gaps(positions)) deepest = std::max(deepest, -gap);
  return deepest;
}

void GapPreserver::adjust(std::span<const double> rest_gaps, std::span<const double> gap_changes,
                          GapSelection selection, Positions& shaped_face) const {
  std::vector<SkinContacts::Range> ranges(rest_gaps.size(), {-HUGE_VAL, HUGE_VAL});
  for (std::size_t p = 0; p < rest_gaps.size(); ++p) {
    if (selection == GapSelection::kNearlyUnchanged && std::abs(gap_changes[p]) > max_gap_change_)
      continue;
    ranges[p] = {rest_gaps[p] + gap_changes[p], rest_gaps[p] + gap_changes[p]};
  }
  contacts_.fit_gaps(ranges, shaped_face);
}

}  // namespace crowdface
