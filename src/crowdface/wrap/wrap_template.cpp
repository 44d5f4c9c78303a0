// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/wrap_template.h"

#include <numeric>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/wrap/scan.h"

namespace crowdface {
namespace {

constexpr Index kMinVertices = 100;

/// Computes the ambient visibility of the skin. For a large skin, computes it only at the vertices
/// of the reduced skin, and interpolates it.
void compute_ambient_visibility(const TemplateOptions& options, WrapTemplate& wrap_template) {
  const Positions normals = vertex_normals(wrap_template.topology, wrap_template.positions);
  const std::vector<Triangle> solid = occluding_triangles(wrap_template);
  SkinMesh& skin = wrap_template.skin;
  if (skin.vertices.size() <= options.max_vertices) {
    skin.ambient_visibility =
        vertex_ambient_visibility(wrap_template.positions, normals, solid, skin.vertices);
    return;
  }
  wrap_template.reduced_skin =
      reduce_skin(skin, skin.rows_of(wrap_template.positions), options.reduced_vertices);
  std::vector<std::uint32_t> rows;
  for (const std::uint32_t v : wrap_template.reduced_skin->mesh.vertices)
    rows.push_back(skin.vertices[v]);
  wrap_template.reduced_skin->mesh.ambient_visibility =
      vertex_ambient_visibility(wrap_template.positions, normals, solid, rows);
  skin.ambient_visibility =
      wrap_template.reduced_skin->interpolate(wrap_template.reduced_skin->mesh.ambient_visibility);
}

}  // namespace

WrapTemplate make_template(const Topology& topology, const Positions& positions,
                           const HeadAxes& axes, const TemplateOptions& options,
                           const std::optional<ReliefMatch>& face) {
  WrapTemplate result{topology, build_adjacency(topology), {}, {}, axes, positions, {}, {}, {}};
  result.components = find_components(result.adjacency);
  result.parts = find_parts(topology, result.adjacency, result.components, positions, {}, axes);
  const Components joined = join_skin(result.components, result.parts);
  const std::uint32_t skin = joined.component_of_vertex.empty() ? 0 : joined.largest();

  result.skin.triangles = triangles_of(topology, joined, skin);
  std::vector<Triangle>& triangles = result.skin.triangles;
  if (!triangles.empty()) {
    result.skin.vertices =
        renumber({triangles.front().data(), 3 * triangles.size()}, topology.vertex_count);
  }
  if (result.skin.vertex_count() < kMinVertices) {
    throw InvalidInput(concat("expected a template with skin of at least ", kMinVertices,
                              " vertices, found ", result.skin.vertex_count()));
  }
  result.skin.adjacency =
      build_adjacency(topology_of(result.skin.triangles, result.skin.vertex_count()));
  compute_ambient_visibility(options, result);
  result.face_match = face ? face : find_face(topology, head_shape(result), axes);
  return result;
}

HeadShape head_shape(const WrapTemplate& wrap_template) {
  HeadShape head;
  head.positions = wrap_template.positions;
  for (const std::uint32_t c : wrap_template.components.component_of_vertex) {
    head.is_skin.push_back(wrap_template.parts.classes[c] == PartClass::kSkin);
  }
  for (const Part& part : wrap_template.parts.parts) {
    if (part.is_eyeball)
      head.eyeball_centres.push_back(wrap_template.parts.shapes[part.ball_component].centre);
  }
  return head;
}

std::vector<Triangle> occluding_triangles(const WrapTemplate& wrap_template) {
  std::vector<Triangle> solid;
  for (const Triangle& t : triangles_of(wrap_template.topology)) {
    if (wrap_template.parts.classes[wrap_template.components.component_of_vertex[t[0]]] !=
        PartClass::kBound) {
      solid.push_back(t);
    }
  }
  return solid;
}

}  // namespace crowdface
