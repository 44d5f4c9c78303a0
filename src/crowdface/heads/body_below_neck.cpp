// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/body_below_neck.h"

#include <algorithm>
#include <string>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/mesh/winding.h"
#include "crowdface/neck/body_below.h"
#include "crowdface/neck/match_rims.h"

namespace crowdface {
namespace {

/// Reads vertex numbers, counted from 0, that form a closed loop.
Rim read_rim(const std::filesystem::path& file, const Adjacency& adjacency) {
  const auto count = static_cast<std::uint64_t>(adjacency.vertex_count());
  std::vector<std::uint32_t> vertices;
  std::string text = read_file(file);
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  for (const std::string& word : words_of(text)) {
    const auto vertex = parse_unsigned(word);
    if (!vertex || *vertex >= count) {
      refuse_file(
          file, concat("expected vertex numbers from 0 to ", count - 1, ", found ", quoted(word)));
    }
    vertices.push_back(static_cast<std::uint32_t>(*vertex));
  }
  Rim rim = rim_through(vertices, adjacency);
  if (rim.empty()) {
    refuse_file(file, concat("expected the vertices of one closed loop of edges, found ",
                             vertices.size(), " vertices that form none"));
  }
  return rim;
}

/// Removes polygons, and the vertices that no remaining polygon uses. Renumbers the vertices.
/// \param kept  for each polygon, whether to keep it
/// \param rim   vertex numbers in `whole`; the function replaces them by the new numbers
ObjFile restrict_to_polygons(const std::vector<bool>& kept, ObjFile whole, Rim& rim) {
  if (std::ranges::all_of(kept, [](bool keep) { return keep; })) return whole;
  FileMesh mesh;
  mesh.uvs = std::move(whole.uvs);
  mesh.materials = std::move(whole.materials);
  std::vector<Index> number;  // for each old polygon, the number of kept polygons before it
  for (Index f = 0; f < whole.topology.face_count(); ++f) {
    number.push_back(mesh.topology.face_count());
    if (!kept[static_cast<std::size_t>(f)]) continue;
    mesh.topology.add_face(whole.topology.face(f), whole.topology.face_uvs(f));
  }
  number.push_back(mesh.topology.face_count());
  for (MaterialRange& range : mesh.materials) {
    range.first_face = number[static_cast<std::size_t>(range.first_face)];
  }
  const std::vector<std::uint32_t> used =
      renumber(mesh.topology.corner_vertices, whole.topology.vertex_count);
  mesh.topology.vertex_count = static_cast<Index>(used.size());
  mesh.positions = whole.positions(used, kAllColumns);
  for (std::uint32_t& v : rim) {
    v = static_cast<std::uint32_t>(std::ranges::lower_bound(used, v) - used.begin());
  }
  ObjFile cut = convert_to_obj(std::move(mesh), whole.path);
  cut.material_libraries = std::move(whole.material_libraries);
  cut.material_base = std::move(whole.material_base);
  return cut;
}

/// Stores the body's mesh. \throws InvalidInput if the file holds a head instead of a body.
void store_body(ObjFile mesh, const Rim& rim, BodyBelowNeck& body) {
  if (body.file_contains_head) {
    throw InvalidInput("body_texture, show_body and write_body need a body, found a head");
  }
  auto kept = std::make_shared<Attachment>();
  kept->name = kept->kind = "body";
  kept->materials = find_material_files(mesh.material_path(), mesh.material_libraries);
  kept->text_digest = Hasher().add(mesh.file.bytes()).digest();
  kept->file = std::move(mesh);
  body.mesh = std::move(kept);
  body.mesh_rim = rim;
}

}  // namespace

Rim find_neck_rim(const Config& config, const Inputs& inputs) {
  if (!config.neck.rim.empty()) return read_rim(config.neck.rim, inputs.adjacency);
  const Components& components = inputs.components;
  std::vector<Rim> rims = find_open_rims(inputs.head_set.topology, inputs.adjacency);
  std::erase_if(rims, [&](const Rim& rim) {
    return components.component_of_vertex[rim.front()] != components.largest();
  });
  return lowest_rim(rims, mean_head(inputs.head_set), unit_vector(config.faces.up),
                    mm_per(config.faces.units));
}

Positions area_vectors_around(const Topology& topology, const Positions& positions,
                              const Rim& rim) {
  const VertexFaces around(topology);
  Positions areas = Positions::Zero(static_cast<Index>(rim.size()), 3);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    for (const std::uint32_t face : around.items_of(rim[i])) {
      areas.row(static_cast<Index>(i)) += face_area_vector(topology, face, positions).transpose();
    }
  }
  return areas;
}

void BodyBelowNeck::reverse_inward_polygons(const Positions& head_areas) {
  if (head_areas.cwiseProduct(area_vectors).sum() >= 0) return;
  area_vectors = -area_vectors;
  if (!mesh) return;
  Topology& topology = mesh->file.topology;
  reverse_faces(topology);
  std::vector<std::uint32_t>& normals = mesh->file.corner_normals;
  for (Index f = 0; f < topology.face_count() && !normals.empty(); ++f) {
    const auto [begin, end] = topology.corners(f);
    if (begin < end) std::reverse(normals.begin() + begin + 1, normals.begin() + end);
  }
}

BodyBelowNeck read_body_below_neck(const Config& config, const Inputs& inputs, const Rim& rim,
                                   const Positions& ring) {
  const Config::Neck& neck = config.neck;
  ObjFile mesh = read_mesh_as_obj(neck.body);
  const double mm = mm_per(config.faces.units);
  const Positions head = mm * ring;
  BodyBelowNeck body;
  body.file_contains_head = first_difference(inputs.head_set.topology, mesh.topology).empty();
  const bool is_order_known = body.file_contains_head && neck.body_rim.empty();
  std::vector<Rim> rims = {rim};
  if (!neck.body_rim.empty()) {
    rims = {read_rim(neck.body_rim, build_adjacency(mesh.topology))};
  } else if (!body.file_contains_head) {
    rims = find_open_rims(mesh.topology, build_adjacency(mesh.topology));
  }
  try {
    Rim found = find_matching_rim(head, rims, mm * mesh.positions, neck.falloff_mm,
                                  is_order_known ? RimOrder::kGiven : RimOrder::kFree);
    body.rim_positions = mesh.positions(found, kAllColumns);
    if (!neck.body_rim.empty()) {
      const std::vector<bool> below =
          polygons_below(mesh.topology, mesh.positions, found, unit_vector(config.faces.up));
      mesh = restrict_to_polygons(below, std::move(mesh), found);
    }
    body.area_vectors = area_vectors_around(mesh.topology, mesh.positions, found);
    if (body.file_contains_head) body.head_positions = mesh.positions;
    if (neck.needs_body_mesh()) store_body(std::move(mesh), found, body);
  } catch (const InvalidInput& error) {
    refuse_file(neck.body, error.what());
  }
  return body;
}

}  // namespace crowdface
