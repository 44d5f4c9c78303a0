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

/// Computes the openness of the skin. For a large skin, computes it only at the vertices of the
/// reduced skin.
void find_openness(const TemplateOptions& options, WrapTemplate& shape) {
  const Positions normals = vertex_normals(shape.topology, shape.positions);
  const std::vector<Triangle> solid = occluding_triangles(shape);
  SkinMesh& skin = shape.skin;
  if (skin.vertices.size() <= options.max_vertices) {
    skin.openness = vertex_openness(shape.positions, normals, solid, skin.vertices);
    return;
  }
  shape.reduced_skin = reduce_skin(skin, skin.rows_of(shape.positions), options.reduced_vertices);
  std::vector<std::uint32_t> rows;
  for (const std::uint32_t v : shape.reduced_skin->mesh.vertices) rows.push_back(skin.vertices[v]);
  shape.reduced_skin->mesh.openness = vertex_openness(shape.positions, normals, solid, rows);
  skin.openness = shape.reduced_skin->interpolate(shape.reduced_skin->mesh.openness);
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
  find_openness(options, result);
  result.face = face ? face : find_face(topology, head_shape(result), axes);
  return result;
}

HeadShape head_shape(const WrapTemplate& shape) {
  HeadShape head;
  head.positions = shape.positions;
  for (const std::uint32_t c : shape.components.component_of_vertex) {
    head.is_skin.push_back(shape.parts.classes[c] == PartClass::kSkin);
  }
  for (const Part& part : shape.parts.parts) {
    if (part.is_eyeball)
      head.eyeball_centres.push_back(shape.parts.shapes[part.ball_component].centre);
  }
  return head;
}

std::vector<Triangle> occluding_triangles(const WrapTemplate& shape) {
  std::vector<Triangle> solid;
  for (const Triangle& t : triangles_of(shape.topology)) {
    if (shape.parts.classes[shape.components.component_of_vertex[t[0]]] != PartClass::kBound) {
      solid.push_back(t);
    }
  }
  return solid;
}

}  // namespace crowdface
