// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/kept_contacts.h"

#include <algorithm>
#include <cmath>

#include "crowdface/parts/component_shape.h"

namespace crowdface {
namespace {

/// As a fraction of the skin's extent; 0.4 mm on a head.
constexpr double kMostChange = 1e-3;

}  // namespace

KeptContacts::KeptContacts(const FaceSet& faces, const Adjacency& adjacency,
                           std::span<const std::uint32_t> skin)
    : contacts_(faces, adjacency, skin),
      most_(kMostChange * extent_of(faces.heads.front().positions, skin)) {}

bool KeptContacts::moved_by(std::span<const std::uint32_t> vertices) const {
  for (std::size_t p = 0; p < contacts_.size(); ++p) {
    for (const auto* profile : {&contacts_.place(p).low, &contacts_.place(p).high}) {
      for (const EdgePoint& point : *profile) {
        if (std::ranges::binary_search(vertices, point.a)) return true;
      }
    }
  }
  return false;
}

std::vector<std::uint32_t> KeptContacts::vertices() const {
  std::vector<std::uint32_t> vertices;
  for (std::size_t p = 0; p < contacts_.size(); ++p) {
    vertices.push_back(contacts_.place(p).low.front().a);
  }
  return vertices;
}

double KeptContacts::deepest(const Positions& positions) const {
  double deepest = 0;
  for (const double gap : gaps(positions)) deepest = std::max(deepest, -gap);
  return deepest;
}

void KeptContacts::keep(std::span<const double> rest, std::span<const double> widening, Keeping how,
                        Positions& shape) const {
  std::vector<SkinContacts::Range> ranges(rest.size(), {-HUGE_VAL, HUGE_VAL});
  for (std::size_t p = 0; p < rest.size(); ++p) {
    if (how == Keeping::kNearlySame && std::abs(widening[p]) > most_) continue;
    ranges[p] = {rest[p] + widening[p], rest[p] + widening[p]};
  }
  contacts_.bring_into(ranges, shape);
}

}  // namespace crowdface
