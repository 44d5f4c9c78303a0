// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/gap_preserver.h"

#include <algorithm>
#include <cmath>

#include "crowdface/parts/component_shape.h"

namespace crowdface {
namespace {

/// Largest change of a gap that counts as nearly the same, as a fraction of the skin's extent: 0.4
/// mm on a head.
constexpr double kMaxChange = 1e-3;

}  // namespace

GapPreserver::GapPreserver(const HeadSet& faces, const Adjacency& adjacency,
                           std::span<const std::uint32_t> skin)
    : contacts_(faces, adjacency, skin),
      max_change_(kMaxChange * extent_of(faces.heads.front().positions, skin)) {}

bool GapPreserver::is_affected_by(std::span<const std::uint32_t> vertices) const {
  for (std::size_t p = 0; p < contacts_.size(); ++p) {
    for (const auto* profile : {&contacts_.place(p).low, &contacts_.place(p).high}) {
      for (const EdgePoint& point : *profile) {
        if (std::ranges::binary_search(vertices, point.a)) return true;
      }
    }
  }
  return false;
}

std::vector<std::uint32_t> GapPreserver::vertices() const {
  std::vector<std::uint32_t> vertices;
  for (std::size_t p = 0; p < contacts_.size(); ++p) {
    vertices.push_back(contacts_.place(p).low.front().a);
  }
  return vertices;
}

double GapPreserver::max_overlap(const Positions& positions) const {
  double deepest = 0;
  for (const double gap : gaps(positions)) deepest = std::max(deepest, -gap);
  return deepest;
}

void GapPreserver::adjust(std::span<const double> rest, std::span<const double> widening,
                          GapSelection how, Positions& shape) const {
  std::vector<SkinContacts::Range> ranges(rest.size(), {-HUGE_VAL, HUGE_VAL});
  for (std::size_t p = 0; p < rest.size(); ++p) {
    if (how == GapSelection::kNearlySame && std::abs(widening[p]) > max_change_) continue;
    ranges[p] = {rest[p] + widening[p], rest[p] + widening[p]};
  }
  contacts_.fit_gaps(ranges, shape);
}

}  // namespace crowdface
