// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/gallery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/pictures/page_pictures.h"
#include "crowdface/pictures/surfaces.h"
#include "crowdface/preview/reduced_mesh.h"
#include "crowdface/render/eyeballs.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/vertex_colours.h"
#include "crowdface/render/visibility.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// Largest number of visible triangles of the reduced mesh. 24,000 triangles have about 12,000
/// vertices of 10 bytes: 160 kB of base64 text per face.
constexpr std::size_t kMaxTriangles = 24'000;
/// Largest number of hidden triangles, such as triangles behind closed lips. Hidden triangles have
/// their own limit, because teeth and mouth cavity have finer meshes than the skin.
constexpr std::size_t kMaxHidden = 2'000;
/// Largest width and height of a face's textures, in texels. With more than two textures, the limit
/// is half of this value.
constexpr int kMaxTexels = 1024;
/// The gallery omits the displacement of a vertex in a blend shape if it is shorter than this.
constexpr double kMinMoveMm = 0.02;
/// If there are blend shapes, smaller values in `sky_visibility_` are raised to this value.
/// Otherwise vertices that no light reaches at rest would stay black when a shape opens the mouth.
constexpr float kMinLight = 0.004F;
constexpr float kUnseen = 0.02F;  ///< vertices that see at most this fraction of the sky are hidden

/// Returns the visible fraction of the sky at the vertices of `triangles`, which are part of a
/// split mesh.
/// \return #V; 0 for vertices that no triangle uses.
std::vector<float> sky_visibility_at(const Topology& topology,
                                     const std::vector<SurfaceKind>& kinds, const Positions& mean,
                                     const SplitMesh& split,
                                     const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> vertices;
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t corner : triangle) vertices.push_back(split.corners[corner].vertex);
  }
  vertices = renumber(vertices, topology.vertex_count);
  const std::vector<float> open = vertex_visibility(topology, kinds, mean, vertices);
  std::vector<float> open_at(static_cast<std::size_t>(topology.vertex_count));
  for (std::size_t v = 0; v < vertices.size(); ++v) open_at[vertices[v]] = open[v];
  return open_at;
}

/// Labels polygons for split_mesh. Polygons with the same label share one texture (or have none) on
/// every head.
/// \return #F labels; kNoIndex for polygons that are not shown.
/// \param faces  number of polygons of the face; all later polygons belong to the body
std::vector<std::uint32_t> texture_labels_of(const HeadTextures& textures,
                                             const std::vector<SurfaceKind>& kinds,
                                             std::size_t faces) {
  constexpr std::uint32_t kBody = kNoIndex - 1;
  std::map<std::vector<std::uint32_t>, std::uint32_t> known;
  std::vector<std::uint32_t> labels;
  for (std::size_t f = 0; f < kinds.size(); ++f) {
    std::vector<std::uint32_t> pictures;
    if (f >= faces) {  // the body
      labels.push_back(
          known.try_emplace({kBody}, static_cast<std::uint32_t>(known.size())).first->second);
      continue;
    }
    if (textures.are_blended()) pictures.push_back(textures.blended.layout.picture_of_polygon[f]);
    for (const TextureSet& texture_set : textures.texture_sets) {
      pictures.push_back(texture_set.texture_of_polygon.empty()
                             ? TextureSet::kNone
                             : texture_set.texture_of_polygon[f]);
    }
    const auto number = static_cast<std::uint32_t>(known.size());
    labels.push_back(kinds[f] == SurfaceKind::kHidden
                         ? kNoIndex
                         : known.try_emplace(pictures, number).first->second);
  }
  return labels;
}

std::vector<const Positions*> positions_of(const HeadSet& head_set) {
  std::vector<const Positions*> heads;
  for (const Head& head : head_set.heads) heads.push_back(&head.positions);
  return heads;
}

/// Returns the coordinate frame for packing positions: a box that encloses all heads, the body and
/// all attachments, because long hair reaches outside the bounding box of the heads.
PackingGrid frame_of(const Inputs& inputs, const Positions& body) {
  std::vector<const Positions*> all = positions_of(inputs.head_set);
  if (body.rows() > 0) all.push_back(&body);
  for (const Attachment& item : inputs.attachments.items) all.push_back(&item.file.positions);
  return PackingGrid::enclosing(all);
}

Json axis_to_json(Axis axis) {
  Json json = {0, 0, 0};
  json[static_cast<std::size_t>(axis.index)] = axis.sign;
  return json;
}

Json to_json(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Returns the text of a JavaScript call with one argument. (JSON is valid JavaScript.)
std::string call(const char* function, const Json& value) {
  return concat("crowdface.", function, "(", value.dump(), ");\n");
}

/// Adds the EyeCoordinates of the vertices of `mesh` to `json`: the position of each vertex
/// relative to its eyeball. The page computes the colours of the irises from these coordinates in
/// each pixel, and so shows finer detail than vertex colours could.
void add_eyes(const Config& config, const Inputs& inputs, const PicturedMesh& whole,
              const PreviewMesh& mesh, Json& json) {
  const PicturedFace mean(whole, inputs.mean_head);
  const auto eyes =
      eye_coordinates(whole.topology(), whole.surfaces(), mean.positions(), config.faces.front);
  if (!eyes) return;
  constexpr float kSteps = 65536;  // number of quantisation steps per radius of the eyeball
  std::vector<std::uint32_t> values;
  for (const std::uint32_t vertex : mesh.vertices) {
    for (int c = 0; c < 3; ++c) {
      const float value = std::clamp((*eyes)(vertex, c), -3.9F, 3.9F);
      values.push_back(static_cast<std::uint32_t>(std::lround(kSteps * (value + 4))));
    }
  }
  const auto colour = [](SurfaceKind kind) {
    const LinearRgb light = albedo_of(kind);
    return Json{light[0], light[1], light[2]};
  };
  json["eyes"] = {{"places", base64(little_endian(values))},
                  {"steps", kSteps},
                  {"pupil", kPupilRadius},
                  {"iris", kIrisRadius},
                  {"softness", kIrisSoftness},
                  {"white", colour(SurfaceKind::kEye)},
                  {"colour", colour(SurfaceKind::kIris)}};
}

}  // namespace

GalleryMeshes::GalleryMeshes(const Config& config, const Inputs& inputs, const PicturedMesh& shown)
    : config_(config),
      inputs_(inputs),
      pictured_mesh_(shown),
      vertex_faces_(shown.topology()),
      packing_grid_(frame_of(inputs, shown.body_points())) {
  const HeadSet& head_set = inputs.head_set;
  const Topology& topology = shown.topology();
  const Surfaces surfaces = shown.surfaces();
  const PicturedFace shown_mean(shown, inputs.mean_head);
  const Positions& mean = shown_mean.positions();
  const std::vector<std::uint32_t> labels =
      texture_labels_of(inputs.textures, surfaces.kinds,
                        static_cast<std::size_t>(inputs.head_set.topology.face_count()));
  const SplitMesh split = split_mesh(topology_to_split(), surfaces.uvs, labels);
  const Positions split_mean = split.corner_positions(mean);
  // Reduce the mesh to 2 · kMaxTriangles, and find out which of the remaining triangles are hidden.
  std::vector<Triangle> triangles =
      reduce_triangles(split.triangles, split_mean, 2 * kMaxTriangles);
  const std::vector<float> open =
      sky_visibility_at(topology, surfaces.kinds, mean, split, triangles);
  std::vector<bool> hidden;
  for (const Triangle& triangle : triangles) {
    hidden.push_back(std::ranges::none_of(triangle, [&](std::uint32_t corner) {
      return open[split.corners[corner].vertex] > kUnseen;
    }));
  }
  // Reduce the visible triangles to kMaxTriangles, and the hidden triangles to kMaxHidden.
  triangles = reduce_hidden(triangles, split_mean, hidden, kMaxTriangles, kMaxHidden);
  mesh_ = preview_from_split_mesh(split, triangles, surfaces.uvs);
  draft_triangles_ = draft_triangles(mesh_, mean, kMaxDraftTriangles);
  for (const std::uint32_t vertex : mesh_.vertices) sky_visibility_.push_back(open[vertex]);
  colours_ =
      surface_colours(topology, surfaces, mean, config.faces.front)(mesh_.vertices, kAllColumns);
  for (std::size_t v = 0; v < mesh_.uvs.size() / 2; ++v) {
    texture_points_.push_back({mesh_.face_of_vertex[v], {mesh_.uvs[2 * v], mesh_.uvs[2 * v + 1]}});
  }
  const std::vector<const Positions*> heads = positions_of(head_set);
  // The bounding box of all heads and the shoulders.
  box_min_ = heads.front()->colwise().minCoeff().transpose();
  box_max_ = heads.front()->colwise().maxCoeff().transpose();
  for (const Positions* head : heads) {
    box_min_ = box_min_.cwiseMin(head->colwise().minCoeff().transpose());
    box_max_ = box_max_.cwiseMax(head->colwise().maxCoeff().transpose());
  }
  if (shown.has_body()) {
    box_min_ = box_min_.cwiseMin(shown.lowest_shown_point());
    box_max_ = box_max_.cwiseMax(shown.lowest_shown_point());
  }
  add_shapes(surfaces, mean);
}

bool GalleryMeshes::colours_body_at_vertices() const {
  return pictured_mesh_.has_body() && config_.neck.body_texture.empty();
}

/// Returns the topology of the pictured mesh. If the gallery colours the body at its vertices, the
/// result has no texture coordinates on the body. With those of BodyPainter, split_mesh would split
/// all vertices of the body, and reduce_triangles could only remove triangles of the face.
Topology GalleryMeshes::topology_to_split() const {
  Topology topology = pictured_mesh_.topology();
  if (!colours_body_at_vertices() || topology.corner_uvs.empty()) return topology;
  const Index faces = inputs_.head_set.topology.face_count();
  const auto first = topology.face_offsets[static_cast<std::size_t>(faces)];
  std::fill(topology.corner_uvs.begin() + first, topology.corner_uvs.end(), kNoIndex);
  return topology;
}

/// Sets the colours of the body's vertices in the reduced mesh to those of the body's texture.
void GalleryMeshes::colour_body(const BlendedPicture& body, VertexColours& colours) const {
  const Topology& topology = pictured_mesh_.topology();
  const Texture texture = texture_of(body, std::max(body.width, body.height));
  const auto faces = static_cast<std::uint32_t>(inputs_.head_set.topology.face_count());
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
    const std::uint32_t polygon = mesh_.face_of_vertex[v];
    if (polygon < faces) continue;
    const auto corners = topology.face(polygon);
    const auto corner = std::ranges::find(corners, mesh_.vertices[v]) - corners.begin();
    const std::uint32_t uv = topology.face_uvs(polygon)[static_cast<std::size_t>(corner)];
    colours.row(static_cast<Index>(v)) =
        to_srgb(colour_at(texture, pictured_mesh_.uvs().row(uv).transpose().cast<float>()))
            .matrix()
            .transpose();
  }
}

double GalleryMeshes::min_displacement() const {
  return kMinMoveMm / mm_per(config_.faces.units);
}

void GalleryMeshes::add_shapes(const Surfaces& surfaces, const Positions& mean) {
  if (inputs_.shapes.shapes.empty()) return;
  const double least = min_displacement();
  for (const Shape& shape : inputs_.shapes.shapes) {
    // Store the vertices of the reduced mesh that the shape moves visibly.
    ShownShape& shown = shown_shapes_.emplace_back();
    const auto& moved = shape.moves.vertices;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
      const auto at = std::ranges::lower_bound(moved, mesh_.vertices[v]);
      if (at == moved.end() || *at != mesh_.vertices[v]) continue;
      const auto row = static_cast<std::uint32_t>(at - moved.begin());
      if (shape.moves.moves.row(row).norm() < least) continue;
      shown.rows.push_back(row);
      shown.vertices.push_back(v);
    }
  }
  // Also compute the visible fraction of the sky for the shape with the largest displacements,
  // because an open mouth lets light reach more vertices.
  const auto& shapes = inputs_.shapes.shapes;
  const auto way = [](const Shape& shape) { return shape.moves.moves.squaredNorm(); };
  shape_with_largest_motion_ = static_cast<std::size_t>(
      std::max_element(shapes.begin(), shapes.end(),
                       [&](const Shape& a, const Shape& b) { return way(a) < way(b); }) -
      shapes.begin());
  Positions acting = mean;
  shapes[shape_with_largest_motion_].moves.add_to(acting);
  sky_visibility_in_shape_with_largest_motion_ =
      vertex_visibility(pictured_mesh_.topology(), surfaces.kinds, acting, mesh_.vertices);
  for (float& open : sky_visibility_) open = std::max(open, kMinLight);
}

std::string GalleryMeshes::pack_shapes(std::span<const Displacements> shape_moves) const {
  std::string bytes;
  for (std::size_t s = 0; s < shape_moves.size(); ++s) {
    for (const std::uint32_t row : shown_shapes_[s].rows) {
      bytes += pack_displacement(shape_moves[s].moves.row(row), packing_grid_);
    }
  }
  return bytes;
}

std::string GalleryMeshes::textures_as_json(const TextureLayer& layer,
                                            std::string (*picture_of)(const Texture&,
                                                                      int max_px)) const {
  std::vector<std::uint32_t> placed;  // indices of textures, without duplicates
  Json pictures = Json::array(), of_look = Json::array();
  for (const std::uint32_t first : mesh_.material_starts) {
    const std::uint32_t face = mesh_.face_of_vertex[mesh_.triangles[3 * first]];
    const std::uint32_t texture =
        layer.texture_of_polygon.empty() ? TextureLayer::kNone : layer.texture_of_polygon[face];
    if (texture == TextureLayer::kNone) {
      of_look.push_back(nullptr);
      continue;
    }
    const auto at = std::ranges::find(placed, texture);
    of_look.push_back(at - placed.begin());
    if (at == placed.end()) placed.push_back(texture);
  }
  const int max_px = placed.size() > 2 ? kMaxTexels / 2 : kMaxTexels;
  for (const std::uint32_t texture : placed) {
    pictures.push_back(picture_of(*layer.textures[texture], max_px));
  }
  return Json{{"pictures", std::move(pictures)}, {"of_look", std::move(of_look)}}.dump();
}

std::string GalleryMeshes::pack_roughness(const TextureSet& texture_set) const {
  std::string bytes;
  if (texture_set.roughness.texture_of_polygon.empty()) return bytes;
  constexpr float kSkin = 0.56F;  // roughness that the page uses for skin without a roughness map
  for (const TexturePoint& place : texture_points_) {
    const float rough = roughness_at(texture_set, place).value_or(kSkin);
    bytes += static_cast<char>(static_cast<std::uint8_t>(std::lround(255 * rough)));
  }
  return bytes;
}

std::string GalleryMeshes::pack_vertex_colours(const VertexColours& colours) const {
  std::string bytes;
  for (Index v = 0; v < colours.rows(); ++v) {
    for (int c = 0; c < 3; ++c) {
      const float byte = std::clamp(255 * colours(v, c), 0.0F, 255.0F);
      bytes += static_cast<char>(static_cast<std::uint8_t>(std::lround(byte)));
    }
  }
  return bytes;
}

std::string GalleryMeshes::shared_script() const {
  Json json;
  json["vertices"] = mesh_.vertices.size();
  json["up"] = axis_to_json(config_.faces.up);
  json["front"] = axis_to_json(config_.faces.front);
  json["low"] = to_json(packing_grid_.low_corner);
  json["step"] = packing_grid_.step;
  json["box"] = {to_json(box_min_), to_json(box_max_)};
  json["triangles"] = base64(little_endian(mesh_.triangles));
  json["draft"] = base64(little_endian(draft_triangles_));
  json["twins"] = base64(little_endian(mesh_.first_copy_of_vertex));
  if (!mesh_.uvs.empty()) {
    json["uvs"] = base64(little_endian(mesh_.uvs));
    json["looks"] = mesh_.material_starts;
  }
  json["colours"] = base64(pack_vertex_colours(colours_));
  add_eyes(config_, inputs_, pictured_mesh_, mesh_, json);
  const auto light = [](const std::vector<float>& open) {
    std::string bytes;
    for (const float share : open) {
      bytes += static_cast<char>(static_cast<std::uint8_t>(std::lround(255 * std::sqrt(share))));
    }
    return base64(bytes);
  };
  json["light"] = light(sky_visibility_);
  if (!shown_shapes_.empty())
    json["widest"] = {{"shape", shape_with_largest_motion_},
                      {"light", light(sky_visibility_in_shape_with_largest_motion_)}};
  for (const ShownShape& shown : shown_shapes_) {
    json["moved"].push_back(base64(little_endian(shown.vertices)));
  }
  return call("setMesh", json);
}

std::string GalleryMeshes::face_script(const std::string& name, const Positions& face,
                                       std::span<const Displacements> moves,
                                       const TextureSet* face_textures,
                                       const VertexColours* face_colours,
                                       const std::vector<PlacedAttachment>& placed,
                                       const BlendedPicture* body) const {
  const bool at_vertices = colours_body_at_vertices();
  const PicturedFace shown(pictured_mesh_, face, face_textures, face_colours,
                           at_vertices ? nullptr : body, kMaxTexels);
  const Positions& positions = shown.positions();
  const TextureSet* const texture_set = shown.textures();
  const VertexColours* const colours = shown.colours();
  std::string bytes =
      pack_face(pictured_mesh_.topology(), mesh_.vertices, vertex_faces_, packing_grid_, positions);
  if (texture_set != nullptr) bytes += pack_roughness(*texture_set);
  std::vector<std::string> parts = {concat("\"points\":\"", base64(bytes), '"')};
  if (!shown_shapes_.empty())
    parts.push_back(concat("\"moves\":\"", base64(pack_shapes(moves)), '"'));
  if (!placed.empty()) {
    std::vector<std::string> packed;
    for (const PlacedAttachment& one : placed) {
      packed.push_back(
          concat(Json(one.look().name()).dump(), ':',
                 attachments_.positions_as_json(one, packing_grid_, min_displacement())));
    }
    parts.push_back(concat("\"worn\":{", join(packed, ","), '}'));
  }
  if (texture_set != nullptr) {
    parts.push_back(concat("\"skin\":", textures_as_json(*texture_set, colour_picture)));
    if (!texture_set->slopes.textures.empty()) {
      parts.push_back(concat("\"relief\":", textures_as_json(texture_set->slopes, normal_picture)));
    }
  }
  if (colours != nullptr || (at_vertices && body != nullptr)) {
    VertexColours reduced =
        colours != nullptr ? VertexColours((*colours)(mesh_.vertices, kAllColumns)) : colours_;
    if (at_vertices && body != nullptr) colour_body(*body, reduced);
    parts.push_back(concat("\"colours\":\"", base64(pack_vertex_colours(reduced)), '"'));
  }
  return concat("crowdface.setFace(", Json(name).dump(), ",{", join(parts, ","), "});\n");
}

std::string GalleryMeshes::attachment_script(const ColouredAttachment& look,
                                             const AttachmentSurfaces& surfaces) const {
  return concat("crowdface.setAttachment(", Json(look.name()).dump(), ',',
                attachments_.appearance_as_json(look, surfaces.at(*look.item)), ");\n");
}

}  // namespace crowdface
