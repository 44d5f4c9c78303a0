// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// How a connected component of a mesh goes along when a face is blended.
enum class PartClass : std::uint8_t {
  kSkin,   ///< blended (Eq. 7)
  kRigid,  ///< as a whole, with the skin around it: eyeballs, teeth
  kBound,  ///< each vertex with the skin nearest to it: lashes, tear lines
};

/// Components that move together.
struct Part {
  PartClass part_class = PartClass::kRigid;
  bool eyeball = false;                   ///< round, of the size of an eye
  std::vector<std::uint32_t> components;  ///< ascending
  std::vector<std::uint32_t> vertices;    ///< ascending
  std::uint32_t ball = kNoIndex;          ///< of an eyeball: its outermost component
  std::vector<std::uint32_t> surface;     ///< of an eyeball: the vertices of that
};

/// What a mesh consists of.
struct PartList {
  std::vector<ComponentShape> shapes;  ///< #components
  std::vector<PartClass> classes;      ///< #components
  std::vector<Part> parts;             ///< by their first component; the skin is none
};

/// What is said about components by hand.
struct PartOverrides {
  std::vector<std::optional<PartClass>> classes;     ///< #components, or empty
  std::vector<std::vector<std::uint32_t>> together;  ///< components that form one part each
};

/// Sorts the components of a mesh into parts by their shapes:
///
/// - skin: the largest, those more than half as long as it, and vertices without faces;
/// - bound: open strips and shells near the skin;
/// - rigid: all else. Round ones of the size of an eye are eyeballs, and what lies inside one is a
///   part of it; of the others, those that nearly touch are one part, unless it falls in two that
///   stand one above the other: the teeth of each jaw.
///
/// \param positions  #V by 3, any unit: best those of the mean head.
PartList find_parts(const Topology& topology, const Adjacency& adjacency,
                    const Components& components, const Positions& positions,
                    const PartOverrides& overrides = {}, const HeadAxes& axes = {});

/// The same components with all skin joined into one, whose number is that of its first; for
/// whoever asks which vertices are skin. Sizes of those joined away are 0.
Components join_skin(const Components& components, const PartList& parts);

/// Vertices that are of no part and of some face, ascending.
std::vector<std::uint32_t> skin_of(const PartList& parts, const FacesAround& around);

}  // namespace crowdface
