// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/shown_attachments.h"

#include <algorithm>
#include <memory>
#include <span>

#include <nlohmann/json.hpp>

#include "crowdface/io/material_files.h"
#include "crowdface/pictures/page_pictures.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// Largest number of triangles of an attachment, all materials together. In each face's script, a
/// vertex takes 8 characters.
constexpr std::size_t kMaxAttachmentTriangles = 24'000;
constexpr std::size_t kMaxAttachmentDraft = 6'000, kMinAttachmentDraft = 300;
constexpr int kMaxAttachmentTexels = 512;

/// Packs the vertices that a blend shape moves by at least `min_displacement`: first the vertex
/// indices (4 bytes each), then the displacements.
/// \param shown  for each vertex of the reduced mesh on the page: its index in the full mesh
std::string packed_moves(std::span<const std::uint32_t> shown, const Displacements& shape,
                         const PackingGrid& frame, double min_displacement) {
  std::vector<std::uint32_t> vertices;
  std::string moves;
  for (std::uint32_t v = 0; v < shown.size(); ++v) {
    const auto at = std::ranges::lower_bound(shape.vertices, shown[v]);
    if (at == shape.vertices.end() || *at != shown[v]) continue;
    const auto move = shape.moves.row(at - shape.vertices.begin());
    if (move.norm() < min_displacement) continue;
    vertices.push_back(v);
    moves += pack_displacement(move, frame);
  }
  return little_endian(vertices) + moves;
}

/// \param positions  the vertex positions in the attachment's file
Json part_to_json(const PreviewMesh& mesh, const Positions& positions,
                  const AttachmentMaterial& material) {
  Json json;
  json["vertices"] = mesh.vertices.size();
  json["triangles"] = base64(little_endian(mesh.triangles));
  const std::size_t most =
      kMaxAttachmentDraft * mesh.triangles.size() / (3 * kMaxAttachmentTriangles);
  json["draft"] = base64(little_endian(
      draft_triangles(mesh, positions, std::max<std::size_t>(kMinAttachmentDraft, most))));
  json["twins"] = base64(little_endian(mesh.first_copy_of_vertex));
  if (!mesh.uvs.empty()) json["uvs"] = base64(little_endian(mesh.uvs));
  json["colour"] = {material.colour[0], material.colour[1], material.colour[2]};
  json["share"] = material.opacity_factor;
  if (mesh.uvs.empty()) return json;
  if (material.texture) json["picture"] = colour_picture(*material.texture, kMaxAttachmentTexels);
  if (material.opacity)
    json["opacity"] = opacity_picture(material.opacity->levels[0], kMaxAttachmentTexels);
  return json;
}

}  // namespace

const ShownAttachments::MaterialMeshes& ShownAttachments::material_meshes(
    const Attachment& item) const {
  return meshes_.get(&item, [&] {
    const ObjFile& file = item.file;
    const PolygonMaterials named = polygon_materials(file.materials, file.topology.face_count());
    auto material_meshes = std::make_unique<MaterialMeshes>();
    const std::size_t materials = std::max<std::size_t>(1, named.names.size());
    for (std::uint32_t m = 0; m < materials; ++m) {
      std::vector<bool> drawn;
      for (const std::uint32_t of_face : named.material_of_polygon) drawn.push_back(of_face == m);
      const auto faces = static_cast<std::size_t>(std::count(drawn.begin(), drawn.end(), true));
      const std::size_t most =
          kMaxAttachmentTriangles * faces / std::max<std::size_t>(1, drawn.size());
      material_meshes->push_back(preview_mesh(file.topology, file.uvs, file.positions, drawn,
                                              std::max<std::size_t>(1, most / 2)));
    }
    return material_meshes;
  });
}

std::string ShownAttachments::appearance_as_json(const ColouredAttachment& look,
                                                 const AttachmentSurface& surface) const {
  const MaterialMeshes& meshes = material_meshes(*look.item);
  Json json = Json::array();
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    json.push_back(part_to_json(meshes[m], look.item->file.positions, surface.materials()[m]));
    if (look.colour) json.back()["tint"] = look.tint();
  }
  return json.dump();
}

std::string ShownAttachments::positions_as_json(const PlacedAttachment& placed,
                                                const PackingGrid& frame,
                                                double min_displacement) const {
  std::vector<std::uint32_t> shown;
  for (const PreviewMesh& part : material_meshes(*placed.item)) {
    shown.insert(shown.end(), part.vertices.begin(), part.vertices.end());
  }
  const std::string points = base64(pack_points(shown, frame, placed.positions));
  Json moves = Json::object();
  for (std::size_t s = 0; s < placed.moves.size(); ++s) {
    const std::string of_shape = packed_moves(shown, placed.moves[s], frame, min_displacement);
    if (!of_shape.empty()) moves[std::to_string(s)] = base64(of_shape);
  }
  return (moves.empty() ? Json(points) : Json{{"points", points}, {"moves", moves}}).dump();
}

std::vector<float> ShownAttachments::vertex_positions(const PlacedAttachment& placed) const {
  std::vector<float> points;
  for (const PreviewMesh& part : material_meshes(*placed.item)) {
    for (const std::uint32_t v : part.vertices) {
      for (int c = 0; c < 3; ++c) points.push_back(static_cast<float>(placed.positions(v, c)));
    }
  }
  return points;
}

}  // namespace crowdface
