// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/part_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/interrupt.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/proximity_joiner.h"

namespace crowdface {
namespace {

// Lengths are fractions of the skin's extent, the diagonal of its bounding box: about 43 cm for a
// head with its neck.

// Smallest extent of a component that counts as skin, as a fraction of the extent of the largest
// component. The largest component always counts as skin.
constexpr double kSkinExtent = 0.5;
constexpr double kMinOpenRatio = 0.7;    // isoperimetric ratio: a hemisphere has 0.5, a disc 1
constexpr double kBoundDistance = 0.04;  // lashes are a few per cent away from the lids
// largest distance of components that nearly touch, such as teeth, as a fraction of the skin's
// extent
constexpr double kTouchDistance = 0.006;
constexpr std::array<double, 2> kEyeRadius = {0.014, 0.08};
/// Smallest diagonal (kMinBallDiagonal) and thickness (kMinBallThickness) of an eyeball's bounding
/// box, in radii. The diagonal is 3.5 radii for a ball and 3 radii for half a ball. Both are at
/// least one radius thick. A row of teeth also fits a sphere, but is only half as thick.
constexpr double kMinBallDiagonal = 2.6, kMinBallThickness = 0.8;
// largest root mean square distance of an eyeball's ball_vertices from the fitted sphere, in radii;
// not zero, because the cornea bulges out of the sphere
constexpr double kMaxRoughness = 0.1;
static_assert(kBoundDistance < kFarFromSkin);

PartClass class_by_shape(const ComponentShape& shape, double extent) {
  if (shape.polygon_count == 0 || shape.extent > kSkinExtent * extent) return PartClass::kSkin;
  const bool open = shape.isoperimetric_ratio > kMinOpenRatio;
  return open && shape.skin_distance < kBoundDistance * extent ? PartClass::kBound
                                                               : PartClass::kRigid;
}

bool is_eyeball(const ComponentShape& shape, double extent) {
  return shape.radius > kEyeRadius[0] * extent && shape.radius < kEyeRadius[1] * extent &&
         shape.extent > kMinBallDiagonal * shape.radius &&
         shape.thickness > kMinBallThickness * shape.radius &&
         shape.roughness < kMaxRoughness * shape.radius;
}

/// Bounding box in the head's axes: side, up, front.
using Box = Eigen::AlignedBox3d;

Box box_of(const Positions& positions, const std::vector<std::uint32_t>& vertices,
           const HeadAxes& axes) {
  Box box;
  for (const std::uint32_t v : vertices) {
    const Eigen::Vector3d point = row3(positions, v);
    box.extend(Eigen::Vector3d(point.dot(axes.side()), point.dot(axes.up), point.dot(axes.front)));
  }
  return box;
}

double box_height(const Box& box) {
  return box.center().y();
}

/// Returns the length by which two boxes overlap along an axis, minus half the length of the
/// shorter box.
double overlap(const Box& a, const Box& b, Index axis) {
  return a.intersection(b).sizes()(axis) - std::min(a.sizes()(axis), b.sizes()(axis)) / 2;
}

/// Returns the number of components that are the teeth of the lower jaw. The widest gap between the
/// mid-heights of successive components separates the two rows of teeth. Returns 0 if the
/// components are not two rows of teeth: the mid-heights of each row must span less than the gap,
/// and the bounding boxes of the rows must overlap in width and depth, but hardly in height.
std::size_t lower_jaw_size(const std::vector<std::pair<Box, std::uint32_t>>& lowest_first) {
  std::size_t lower = 0;
  double widest = 0;
  for (std::size_t i = 1; i < lowest_first.size(); ++i) {
    const double gap = box_height(lowest_first[i].first) - box_height(lowest_first[i - 1].first);
    if (gap <= widest) continue;
    widest = gap;
    lower = i;
  }
  if (lower == 0) return 0;
  Box below, above;
  for (std::size_t i = 0; i < lowest_first.size(); ++i) {
    (i < lower ? below : above).extend(lowest_first[i].first);
  }
  const double spread =
      std::max(box_height(lowest_first[lower - 1].first) - box_height(lowest_first.front().first),
               box_height(lowest_first.back().first) - box_height(lowest_first[lower].first));
  const bool stacked = spread < widest && overlap(below, above, 1) < 0;
  const bool over = overlap(below, above, 0) > 0 && overlap(below, above, 2) > 0;
  return stacked && over ? lower : 0;
}

/// Joins each eyeball with the components whose centre is inside the eyeball.
void join_inside(const PartList& list, const std::vector<std::uint32_t>& rigid,
                 const std::vector<bool>& eyeball, DisjointSets& grouping) {
  Positions centres(static_cast<Index>(list.shapes.size()), 3);
  std::vector<std::uint32_t> self(list.shapes.size()), found;
  std::iota(self.begin(), self.end(), 0U);
  for (const std::uint32_t c : rigid) {
    centres.row(c) = list.shapes[c].centre.transpose();
    // the fit of a sphere may fail for a component without extent
    if (list.shapes[c].centre.allFinite()) found.push_back(c);
  }
  ProximityJoiner tree(centres, std::move(found), self, grouping);
  for (const std::uint32_t c : rigid) {
    throw_if_interrupted();
    if (!eyeball[c]) continue;
    tree.join_near(list.shapes[c].centre, std::nextafter(list.shapes[c].radius, 0.0), c);
  }
}

/// Joins two rigid components if a vertex of one is at most `reach` away from a vertex of the
/// other. Leaves out eyeballs.
void join_touching(const Positions& positions, const Components& components,
                   const std::vector<std::vector<std::uint32_t>>& members,
                   const std::vector<std::uint32_t>& rigid, const std::vector<bool>& eyeball,
                   double reach, DisjointSets& grouping) {
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t c : rigid) {
    if (!eyeball[c]) vertices.insert(vertices.end(), members[c].begin(), members[c].end());
  }
  ProximityJoiner tree(positions, vertices, components.component_of_vertex, grouping);
  for (const std::uint32_t v : vertices) {
    throw_if_interrupted();
    tree.join_near(positions.row(v).transpose(), reach, components.component_of_vertex[v]);
  }
}

/// Splits each group that contains two rows of teeth into one group per jaw.
void split_jaws(const Positions& positions, const std::vector<std::vector<std::uint32_t>>& members,
                const HeadAxes& axes, const std::vector<std::uint32_t>& rigid,
                const std::vector<bool>& eyeball, DisjointSets& grouping) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
  for (const std::uint32_t c : rigid) groups[grouping.root(c)].push_back(c);
  for (auto& [root, group] : groups) {
    const auto is_eyeball = [&](std::uint32_t c) { return eyeball[c]; };
    if (group.size() < 2 || std::ranges::any_of(group, is_eyeball)) continue;
    std::vector<std::pair<Box, std::uint32_t>> boxes;
    for (const std::uint32_t c : group) boxes.emplace_back(box_of(positions, members[c], axes), c);
    std::ranges::stable_sort(boxes, {}, [](const auto& box) { return box_height(box.first); });
    const std::size_t lower = lower_jaw_size(boxes);
    if (lower == 0) continue;
    for (const std::uint32_t c : group) grouping.release(c);
    for (std::size_t i = 0; i + 1 < boxes.size(); ++i) {
      if (i + 1 != lower) grouping.join(boxes[i].second, boxes[i + 1].second);
    }
  }
}

}  // namespace

PartList find_parts(const Topology& topology, const Adjacency& adjacency,
                    const Components& components, const Positions& positions,
                    const PartOverrides& overrides, const HeadAxes& axes) {
  PartList list;
  list.shapes = component_shapes(topology, adjacency, components, positions);
  const auto count = static_cast<std::uint32_t>(list.shapes.size());
  const std::uint32_t skin = components.largest();
  const double extent = list.shapes[skin].extent;
  for (std::uint32_t c = 0; c < count; ++c) {
    list.classes.push_back(c == skin ? PartClass::kSkin : class_by_shape(list.shapes[c], extent));
    if (!overrides.classes.empty() && overrides.classes[c]) list.classes[c] = *overrides.classes[c];
  }

  const std::vector<std::vector<std::uint32_t>> members = vertices_of_components(components);
  DisjointSets grouping(count);
  // Join the components that the user assigned to one part.
  std::vector<bool> is_user_assigned(count, false);
  for (const auto& together : overrides.joined_components) {
    for (const std::uint32_t c : together) {
      is_user_assigned[c] = true;
      grouping.join(together.front(), c);
    }
  }
  std::vector<bool> eyeball(count, false);
  std::vector<std::uint32_t> rigid;
  for (std::uint32_t c = 0; c < count; ++c) {
    if (list.classes[c] != PartClass::kRigid) continue;
    eyeball[c] = is_eyeball(list.shapes[c], extent);
    if (!is_user_assigned[c]) rigid.push_back(c);
  }
  // Join rigid components with one another into parts: components inside eyeballs, and components
  // that touch. Leave out components that the user assigned.
  join_inside(list, rigid, eyeball, grouping);
  join_touching(positions, components, members, rigid, eyeball, kTouchDistance * extent, grouping);
  split_jaws(positions, members, axes, rigid, eyeball, grouping);

  // Create one part for each group.
  std::vector<std::size_t> part_of(count, SIZE_MAX);
  for (std::uint32_t c = 0; c < count; ++c) {
    if (list.classes[c] == PartClass::kSkin) continue;
    const std::uint32_t root = grouping.root(c);
    if (part_of[root] == SIZE_MAX) {
      part_of[root] = list.parts.size();
      list.parts.push_back({list.classes[c], false, {}, {}, kNoIndex, {}});
    }
    Part& part = list.parts[part_of[root]];
    if (list.classes[c] == PartClass::kRigid) part.part_class = PartClass::kRigid;
    part.is_eyeball = part.is_eyeball || eyeball[c];
    if (part.ball_component == kNoIndex ||
        list.shapes[c].radius > list.shapes[part.ball_component].radius) {
      part.ball_component = c;
    }
    part.components.push_back(c);
    part.vertices.insert(part.vertices.end(), members[c].begin(), members[c].end());
  }
  for (Part& part : list.parts) {
    std::ranges::sort(part.vertices);
    if (part.is_eyeball) part.ball_vertices = members[part.ball_component];
  }
  return list;
}

Components join_skin(const Components& components, const PartList& parts) {
  Components joined = components;
  std::uint32_t first = kNoIndex;
  for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(parts.classes.size()); ++c) {
    if (parts.classes[c] != PartClass::kSkin || parts.shapes[c].polygon_count == 0) continue;
    if (first == kNoIndex) {
      first = c;
      continue;
    }
    joined.sizes[first] += joined.sizes[c];
    joined.sizes[c] = 0;
  }
  for (std::uint32_t& c : joined.component_of_vertex) {
    if (parts.classes[c] == PartClass::kSkin && parts.shapes[c].polygon_count > 0) c = first;
  }
  return joined;
}

std::vector<std::uint32_t> skin_of(const PartList& parts, const VertexFaces& vertex_faces) {
  std::vector<bool> is_skin(vertex_faces.group_count(), true);
  for (const Part& part : parts.parts) {
    for (const std::uint32_t v : part.vertices) is_skin[v] = false;
  }
  std::vector<std::uint32_t> skin;
  for (std::uint32_t v = 0; v < is_skin.size(); ++v) {
    if (is_skin[v] && !vertex_faces.items_of(v).empty()) skin.push_back(v);
  }
  return skin;
}

}  // namespace crowdface
