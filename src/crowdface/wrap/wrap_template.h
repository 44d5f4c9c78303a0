// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/paint/face_marks.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/wrap/reduced_skin.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// A template, sorted into skin and parts that follow it; made once for any number of scans.
struct WrapTemplate {
  Topology topology;
  Adjacency adjacency;
  Components components;
  PartList parts;
  HeadAxes axes;
  Positions positions;  ///< #V by 3, in millimetres
  SkinMesh skin;
  std::optional<ReliefMatch> face;     ///< nothing if the skin does not have the relief of a face
  std::optional<ReducedSkin> reduced;  ///< what a skin of many vertices is bent by
};

struct TemplateOptions {
  /// Skins of more vertices are bent by way of one with about `reduced_vertices`.
  std::size_t most_vertices = 20000, reduced_vertices = 12000;
};

/// Finds skin and parts. \param positions  #V by 3, in millimetres.
/// \param face  where the face is if that is known; otherwise it is looked for
/// \throws InvalidInput if there is no skin to speak of.
WrapTemplate make_template(const Topology& topology, const Positions& positions,
                           const HeadAxes& axes, const TemplateOptions& options = {},
                           const std::optional<ReliefMatch>& face = {});

/// The template as far as its face is looked for.
HeadShape head_shape(const WrapTemplate& shape);

/// Triangles in the way of a look at the skin: all but lashes and tear lines.
std::vector<Triangle> solid_triangles(const WrapTemplate& shape);

}  // namespace crowdface
