// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/wrap_template.h"

#include <numeric>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/wrap/scan.h"

namespace crowdface {
namespace {

constexpr Index kFewestVertices = 100;

/// Of a large skin only what stands for it is looked at.
void find_openness(const TemplateOptions& options, WrapTemplate& shape) {
  const Positions normals = vertex_normals(shape.topology, shape.positions);
  const std::vector<Triangle> solid = solid_triangles(shape);
  SkinMesh& skin = shape.skin;
  if (skin.vertices.size() <= options.most_vertices) {
    skin.openness = vertex_openness(shape.positions, normals, solid, skin.vertices);
    return;
  }
  shape.reduced = reduce_skin(skin, skin.of(shape.positions), options.reduced_vertices);
  std::vector<std::uint32_t> rows;
  for (const std::uint32_t v : shape.reduced->mesh.vertices) rows.push_back(skin.vertices[v]);
  shape.reduced->mesh.openness = vertex_openness(shape.positions, normals, solid, rows);
  skin.openness = shape.reduced->carry(shape.reduced->mesh.openness);
}

}  // namespace

WrapTemplate make_template(const Topology& topology, const Positions& positions,
                           const HeadAxes& axes, const TemplateOptions& options) {
  WrapTemplate result{topology, build_adjacency(topology), {}, {}, axes, positions, {}, {}};
  result.components = find_components(result.adjacency);
  result.parts = find_parts(topology, result.adjacency, result.components, positions, {}, axes);
  const Components joined = join_skin(result.components, result.parts);
  const std::uint32_t skin = joined.of_vertex.empty() ? 0 : joined.largest();

  std::vector<std::uint32_t> number(static_cast<std::size_t>(topology.vertex_count), kNoIndex);
  for (const Triangle& t : triangles_of(topology, joined, skin)) {
    for (const std::uint32_t v : t) number[v] = 0;
  }
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNoIndex) continue;
    number[v] = static_cast<std::uint32_t>(result.skin.vertices.size());
    result.skin.vertices.push_back(v);
  }
  if (result.skin.vertex_count() < kFewestVertices) {
    throw InvalidInput(concat("expected a template with skin of at least ", kFewestVertices,
                              " vertices, found ", result.skin.vertex_count()));
  }
  for (const Triangle& t : triangles_of(topology, joined, skin)) {
    result.skin.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }
  result.skin.adjacency =
      build_adjacency(topology_of(result.skin.triangles, result.skin.vertex_count()));
  find_openness(options, result);
  return result;
}

std::vector<Triangle> solid_triangles(const WrapTemplate& shape) {
  std::vector<Triangle> solid;
  for (const Triangle& t : triangles_of(shape.topology)) {
    if (shape.parts.classes[shape.components.of_vertex[t[0]]] != PartClass::kBound) {
      solid.push_back(t);
    }
  }
  return solid;
}

}  // namespace crowdface
