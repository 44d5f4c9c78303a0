// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/paint/face_marks.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/wrap/reduced_skin.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// A template separated into skin and parts that follow the skin; built once for any number of
/// scans.
struct WrapTemplate {
  Topology topology;
  Adjacency adjacency;    ///< neighbours of each vertex along edges
  Components components;  ///< connected components of the mesh
  PartList parts;         ///< which of the components are skin, and the other components' parts
  HeadAxes axes;          ///< up and front direction of the template's head
  Positions positions;    ///< #V by 3, in millimetres
  SkinMesh skin;
  /// the face found on the skin; nothing if the skin does not have the relief of a face
  std::optional<ReliefMatch> face_match;
  /// The mesh that is deformed in place of the skin. Nothing if the skin has few vertices and is
  /// deformed itself (see `TemplateOptions`).
  std::optional<ReducedSkin> reduced_skin;
};

/// Settings of `make_template`.
struct TemplateOptions {
  /// If a skin has more than `max_vertices` vertices, a reduced skin with about `reduced_vertices`
  /// vertices is deformed instead, and the result is interpolated.
  std::size_t max_vertices = 20000, reduced_vertices = 12000;
};

/// Separates a template into skin and parts.
/// \param positions  #V by 3, in millimetres.
/// \param face  the face, if known; otherwise the function searches for it.
/// \throws InvalidInput if the template has hardly any skin.
WrapTemplate make_template(const Topology& topology, const Positions& positions,
                           const HeadAxes& axes, const TemplateOptions& options = {},
                           const std::optional<ReliefMatch>& face = {});

/// Returns the template as a HeadShape, the input of `find_face` and `marks_of_face`.
HeadShape head_shape(const WrapTemplate& wrap_template);

/// The triangles that can hide the skin from view: all triangles except those of lashes and tear
/// lines.
std::vector<Triangle> occluding_triangles(const WrapTemplate& wrap_template);

}  // namespace crowdface
