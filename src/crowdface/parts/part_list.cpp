// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/part_list.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "crowdface/parts/point_grid.h"

namespace crowdface {
namespace {

// Lengths are shares of the skin's extent, the diagonal of its bounding box: some 43 cm for a head
// with its neck.
constexpr double kSkinExtent = 0.5;      // a second piece of skin is at least as long as this
constexpr double kOpen = 0.7;            // a hemisphere has an openness of 0.5, a disc of 1
constexpr double kBoundDistance = 0.04;  // lashes stand a few per cent off the lids
constexpr double kTouch = 0.006;         // teeth stand side by side
constexpr std::array<double, 2> kEyeRadius = {0.014, 0.08};
/// A ball's bounding box is 3.5 radii across, half a ball's 3; a row of teeth lies on an arc as well,
/// but its box is smaller.
constexpr double kWhole = 2.6;
constexpr double kRound = 0.1;  // roughness of an eyeball as a share of its radius: the cornea

PartClass class_by_shape(const ComponentShape& shape, double extent) {
  if (shape.faces == 0 || shape.extent > kSkinExtent * extent) return PartClass::kSkin;
  const bool open = shape.openness > kOpen;
  return open && shape.skin_distance < kBoundDistance * extent ? PartClass::kBound
                                                               : PartClass::kRigid;
}

bool is_eyeball(const ComponentShape& shape, double extent) {
  return shape.radius > kEyeRadius[0] * extent && shape.radius < kEyeRadius[1] * extent &&
         shape.extent > kWhole * shape.radius && shape.roughness < kRound * shape.radius;
}

/// Which rigid components move as one.
class Grouping {
 public:
  explicit Grouping(std::size_t components) : parent_(components) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t root(std::uint32_t c) const {
    while (parent_[c] != c) c = parent_[c];
    return c;
  }
  /// The smaller number is the root, so that parts are called after their first component.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

bool touch(const PointGrid& grid, const Positions& positions,
           const std::vector<std::uint32_t>& vertices, double reach) {
  return std::any_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) {
    return grid.nearest(positions.row(v).transpose(), reach).vertex != kNoIndex;
  });
}

}  // namespace

PartList find_parts(const Topology& topology, const Adjacency& adjacency,
                    const Components& components, const Positions& positions,
                    const PartOverrides& overrides) {
  PartList list;
  list.shapes = component_shapes(topology, adjacency, components, positions);
  const auto count = static_cast<std::uint32_t>(list.shapes.size());
  const std::uint32_t skin = components.largest();
  const double extent = list.shapes[skin].extent;
  for (std::uint32_t c = 0; c < count; ++c) {
    list.classes.push_back(c == skin ? PartClass::kSkin : class_by_shape(list.shapes[c], extent));
    if (!overrides.classes.empty() && overrides.classes[c]) list.classes[c] = *overrides.classes[c];
  }

  std::vector<std::vector<std::uint32_t>> members(count);
  for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(topology.vertex_count); ++v) {
    const std::uint32_t c = components.of_vertex[v];
    if (list.classes[c] != PartClass::kSkin) members[c].push_back(v);
  }
  Grouping grouping(count);
  std::vector<bool> by_hand(count, false);
  for (const auto& together : overrides.together) {
    for (const std::uint32_t c : together) {
      by_hand[c] = true;
      grouping.join(together.front(), c);
    }
  }
  std::vector<bool> eyeball(count, false);
  for (std::uint32_t c = 0; c < count; ++c) {
    eyeball[c] = list.classes[c] == PartClass::kRigid && is_eyeball(list.shapes[c], extent);
  }
  for (std::uint32_t a = 0; a < count; ++a) {
    if (list.classes[a] != PartClass::kRigid || by_hand[a]) continue;
    const PointGrid grid(positions, members[a]);
    for (std::uint32_t b = 0; b < count; ++b) {
      if (b == a || list.classes[b] != PartClass::kRigid || by_hand[b]) continue;
      const Eigen::Vector3d between = list.shapes[a].centre - list.shapes[b].centre;
      const bool inside = eyeball[a] && between.norm() < list.shapes[a].radius;
      const bool beside = b > a && !eyeball[a] && !eyeball[b] &&
                          touch(grid, positions, members[b], kTouch * extent);
      if (inside || beside) grouping.join(a, b);
    }
  }

  std::vector<std::size_t> part_of(count, SIZE_MAX);
  for (std::uint32_t c = 0; c < count; ++c) {
    if (list.classes[c] == PartClass::kSkin) continue;
    const std::uint32_t root = grouping.root(c);
    if (part_of[root] == SIZE_MAX) {
      part_of[root] = list.parts.size();
      list.parts.push_back({list.classes[c], false, {}, {}});
    }
    Part& part = list.parts[part_of[root]];
    if (list.classes[c] == PartClass::kRigid) part.part_class = PartClass::kRigid;
    part.eyeball = part.eyeball || eyeball[c];
    part.components.push_back(c);
    part.vertices.insert(part.vertices.end(), members[c].begin(), members[c].end());
  }
  for (Part& part : list.parts) std::sort(part.vertices.begin(), part.vertices.end());
  return list;
}

Components join_skin(const Components& components, const PartList& parts) {
  Components joined = components;
  std::uint32_t first = kNoIndex;
  for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(parts.classes.size()); ++c) {
    if (parts.classes[c] != PartClass::kSkin || parts.shapes[c].faces == 0) continue;
    if (first == kNoIndex) {
      first = c;
      continue;
    }
    joined.sizes[first] += joined.sizes[c];
    joined.sizes[c] = 0;
  }
  for (std::uint32_t& c : joined.of_vertex) {
    if (parts.classes[c] == PartClass::kSkin && parts.shapes[c].faces > 0) c = first;
  }
  return joined;
}

}  // namespace crowdface
