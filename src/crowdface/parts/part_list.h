// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// How a connected component of a mesh moves when a face is blended.
enum class PartClass : std::uint8_t {
  kSkin,   ///< the positions of its vertices are blended (see blend_exact)
  kRigid,  ///< moves as a whole with the skin around it: eyeballs, teeth
  kBound,  ///< each vertex moves with the nearest skin: lashes, tear lines
};

/// Components that move together.
struct Part {
  PartClass part_class = PartClass::kRigid;
  bool is_eyeball = false;                  ///< whether the part is round and as large as an eye
  std::vector<std::uint32_t> components;    ///< indices of the part's components, ascending
  std::vector<std::uint32_t> vertices;      ///< vertices of all the part's components, ascending
  std::uint32_t ball_component = kNoIndex;  ///< only for an eyeball: the largest of `components`
  /// only for an eyeball: the vertices of `ball_component`
  std::vector<std::uint32_t> ball_vertices;
};

/// The parts of a mesh.
struct PartList {
  std::vector<ComponentShape> shapes;  ///< for each component of the mesh: its shape
  std::vector<PartClass> classes;      ///< for each component of the mesh: how it moves
  /// ordered by their first components; the skin is not a part
  std::vector<Part> parts;
};

/// The user's assignments of components to classes and parts.
struct PartOverrides {
  /// one per component (nullopt: not assigned), or empty
  std::vector<std::optional<PartClass>> classes;
  /// for each part, the indices of its components
  std::vector<std::vector<std::uint32_t>> joined_components;
};

/// Classifies the components of a mesh by their shapes and joins them into parts:
///
/// - skin: the largest component, every component with more than half of the largest component's
///   extent, and vertices without polygons;
/// - bound: open strips and shells near the skin;
/// - rigid: all other components. Round components as large as an eye are eyeballs; a component
///   whose centre is inside an eyeball joins the eyeball's part. Other rigid components that nearly
///   touch form one part. Exception: if rigid components form two rows, one above the other, the
///   rows are the teeth of two jaws, and each row is a separate part.
///
/// \param positions  #V by 3, any unit; preferably the mean head.
PartList find_parts(const Topology& topology, const Adjacency& adjacency,
                    const Components& components, const Positions& positions,
                    const PartOverrides& overrides = {}, const HeadAxes& axes = {});

/// Returns a copy of `components` in which all vertices of skin belong to the first skin component.
/// The other skin components become empty.
Components join_skin(const Components& components, const PartList& parts);

/// Returns the vertices that belong to a polygon but to no part, ascending.
std::vector<std::uint32_t> skin_of(const PartList& parts, const VertexFaces& vertex_faces);

}  // namespace crowdface
