// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/mesh_writers.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/io/npy.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/surface_kind.h"
#include "crowdface/run/own_textures.h"

namespace crowdface {
namespace {

/// The colour of the renders. What they do not draw (lashes, shells over the eye) cannot be seen
/// here either: without its texture it would hide the eye.
GlbMaterial glb_material(const std::string& name) {
  const SurfaceKind kind = surface_kind_of_material(name);
  const Light colour = albedo_of(kind);
  const float opacity = kind == SurfaceKind::kHidden ? 0.0F : 1.0F;
  return {name, {colour(0), colour(1), colour(2), opacity}};
}

/// A material for each that faces have together with a picture of their own textures.
void add_textured_materials(const Config& config, const Inputs& inputs, GlbOptions& options) {
  options.images = inputs.textures.names.size();
  if (config.textures.formats.front() == TextureFormat::kJpeg) options.image_type = "image/jpeg";
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  for (std::size_t f = 0; f < options.face_materials.size(); ++f) {
    const std::uint32_t material = options.face_materials[f];
    const std::uint32_t picture = inputs.textures.blended.layout.of_face[f];
    const auto [row, is_new] =
        known.emplace(std::pair(material, picture), static_cast<std::uint32_t>(known.size()));
    options.face_materials[f] = row->second;
    if (!is_new) continue;
    GlbMaterial made = glb_material(inputs.materials.names[material]);
    if (picture != kNoIndex) {
      made.colour = {1, 1, 1, made.colour[3]};
      made.image = picture;
    }
    options.materials.push_back(std::move(made));
  }
}

GlbOptions glb_options(const Config& config, const Inputs& inputs) {
  GlbOptions options;
  options.unit = config.faces.units;
  options.up = config.faces.up;
  options.front = config.faces.front;
  options.face_materials = inputs.materials.of_face;
  for (const Shape& shape : inputs.shapes.shapes) {
    options.targets.push_back({shape.name, shape.moves.vertices});
  }
  if (inputs.textures.blend()) {
    add_textured_materials(config, inputs, options);
  } else {
    for (const std::string& name : inputs.materials.names) {
      options.materials.push_back(glb_material(name));
    }
  }
  return options;
}

std::size_t normals_bytes(const Topology& topology) {
  return static_cast<std::size_t>(topology.vertex_count + topology.face_count()) * 3 *
         sizeof(double);
}

std::size_t shape_bytes(const ShapeSet& shapes) {
  std::size_t vertices = 0;
  for (const Shape& shape : shapes.shapes) vertices += shape.moves.vertices.size();
  return vertices * (3 * sizeof(double) + sizeof(std::uint32_t));
}

}  // namespace

std::vector<MeshName> mesh_names(const std::vector<MeshFormat>& formats, const ShapeSet& shapes) {
  std::vector<MeshName> names;
  for (const MeshFormat format : formats) names.push_back({format, {}});
  if (shapes.shapes.empty()) return names;
  for (const MeshFormat format : formats) {
    if (format == MeshFormat::kPoints) names.push_back({format, kAllShapes});
    if (format != MeshFormat::kObj) continue;
    for (const Shape& shape : shapes.shapes) names.push_back({format, shape.name});
  }
  return names;
}

MeshWriters::MeshWriters(const Config& config, const Inputs& inputs,
                         std::vector<MeshFormat> formats, std::span<const CastFace> crowd)
    : inputs_(inputs), formats_(std::move(formats)), names_(mesh_names(formats_, inputs.shapes)) {
  const FaceSet& faces = inputs.faces;
  std::set<Index> targets;
  for (const CastFace& face : crowd) targets.insert(face.recipe.target);
  const bool need_normals =
      std::ranges::any_of(targets, [&](Index target) { return needs_normals(target); });
  if (has(MeshFormat::kObj)) add_obj_templates({targets.begin(), targets.end()});
  if (has(MeshFormat::kPly)) ply_.emplace(faces.topology);
  if (has(MeshFormat::kGlb)) {
    glb_.emplace(faces.topology, faces.uvs, glb_options(config, inputs));
  }
  if (need_normals) fans_.emplace(faces.topology);
  if (!inputs.shapes.shapes.empty() && (has(MeshFormat::kGlb) || names_.size() > formats_.size())) {
    shapes_.emplace(faces, inputs.adjacency, inputs.parts, head_axes(config), inputs.shapes);
  }
}

void MeshWriters::add_obj_templates(const std::vector<Index>& targets) {
  std::vector<std::optional<ObjTemplate>> forms(targets.size());
  parallel_for_each(targets.size(), [&](std::size_t t) {
    forms[t].emplace(inputs_.files[static_cast<std::size_t>(targets[t])], inputs_.faces.topology);
  });
  for (std::size_t t = 0; t < targets.size(); ++t) obj_.emplace(targets[t], std::move(*forms[t]));
}

bool MeshWriters::has(MeshFormat format) const {
  return std::find(formats_.begin(), formats_.end(), format) != formats_.end();
}

bool MeshWriters::had_normals(Index target) const {
  return !inputs_.files[static_cast<std::size_t>(target)].corner_normals.empty();
}

/// Those of an OBJ file are its own affair: several may meet at a vertex.
bool MeshWriters::needs_normals(Index target) const {
  return has(MeshFormat::kGlb) || (has(MeshFormat::kPly) && had_normals(target));
}

EncodedFile MeshWriters::encode(const MeshName& mesh, const CastFace& face,
                                const Positions& positions, const Positions& normals,
                                std::span<const Displacements> moves,
                                std::span<const std::string_view> textures) const {
  const std::string& id = face.id;
  const Index target = face.recipe.target;
  switch (mesh.format) {
    case MeshFormat::kObj: {
      if (mesh.shape.empty()) return obj_.at(target).encode(positions, id);
      const std::vector<Shape>& shapes = inputs_.shapes.shapes;
      const auto shape = std::find_if(shapes.begin(), shapes.end(),
                                      [&](const Shape& known) { return known.name == mesh.shape; });
      Positions moved = positions;
      moves[static_cast<std::size_t>(shape - shapes.begin())].add_to(moved);
      return obj_.at(target).encode(moved, concat(id, ", ", mesh.shape));
    }
    case MeshFormat::kPly:
      return ply_->encode(positions, had_normals(target) ? normals : Positions(), id);
    case MeshFormat::kGlb:
      return glb_->encode(positions, normals, id, moves, textures);
    case MeshFormat::kPoints:
      return mesh.shape.empty() ? encode_npy(positions, id) : encode_npy(moves, id);
  }
  throw BrokenPrecondition("MeshWriters: an unknown format");
}

std::vector<EncodedMesh> MeshWriters::encode(const CastFace& face, const Positions& positions,
                                             std::span<const std::string_view> textures) const {
  Positions normals;
  if (needs_normals(face.recipe.target)) {
    normals = vertex_normals(*fans_, inputs_.faces.topology, positions);
  }
  std::vector<Displacements> moves;
  if (shapes_) moves = shapes_->carry(face.recipe.target, positions);
  std::vector<EncodedMesh> meshes;
  for (const MeshName& name : names_) {
    meshes.push_back({name, encode(name, face, positions, normals, moves, textures)});
    if (name.format == MeshFormat::kObj && !textures.empty()) {
      meshes.back().file.replace_line("mtllib", concat("mtllib ", material_file_name(face.id)));
    }
  }
  return meshes;
}

std::size_t MeshWriters::memory_bytes() const {
  std::size_t bytes = fans_ ? fans_->memory_bytes() : 0;
  for (const auto& [target, form] : obj_) bytes += form.memory_bytes();
  if (ply_) bytes += ply_->memory_bytes();
  if (glb_) bytes += glb_->memory_bytes();
  if (shapes_) bytes += shape_bytes(inputs_.shapes);
  return bytes;
}

std::size_t MeshWriters::encode_bytes() const {
  std::size_t obj = 0;
  for (const auto& [target, form] : obj_) obj = std::max(obj, form.encode_bytes());
  if (shapes_ && has(MeshFormat::kObj)) obj *= 1 + inputs_.shapes.shapes.size();
  std::size_t bytes = (shapes_ ? 2 * shape_bytes(inputs_.shapes) : 0) + obj +
                      (fans_ ? normals_bytes(inputs_.faces.topology) : 0);
  if (ply_) bytes += ply_->encode_bytes(PlyTemplate::Normals::kVertex);
  if (glb_) bytes += glb_->encode_bytes();
  if (has(MeshFormat::kPoints)) bytes += npy_encode_bytes(inputs_.faces.topology.vertex_count);
  return bytes;
}

MeshFile write_mesh(const EncodedMesh& mesh, const std::filesystem::path& path) {
  mesh.file.write(path);
  return {mesh.name, mesh.file.digest(), mesh.file.size()};
}

std::uint64_t estimate_mesh_bytes(const Inputs& inputs, const std::vector<MeshFormat>& formats) {
  const auto vertices = static_cast<std::uint64_t>(inputs.faces.topology.vertex_count);
  const auto faces = static_cast<std::uint64_t>(inputs.faces.topology.face_count());
  const auto corners = static_cast<std::uint64_t>(inputs.faces.topology.corner_count());
  constexpr std::uint64_t kVector = 3 * sizeof(float);
  std::uint64_t obj = 0, bytes = 0, moved = 0;
  for (const Shape& shape : inputs.shapes.shapes) moved += shape.moves.vertices.size();
  for (const ObjFile& file : inputs.files) obj += file.file.bytes().size();
  for (const MeshFormat format : formats) {
    switch (format) {
      case MeshFormat::kObj:
        bytes += obj / inputs.files.size() * (1 + inputs.shapes.shapes.size());
        break;
      case MeshFormat::kPly:
        bytes += kVector * vertices + faces + sizeof(std::uint32_t) * corners;
        break;
      case MeshFormat::kGlb:  // positions, normals, texture coordinates, ids; triangles
        bytes += 3 * kVector * vertices + kVector * (corners - 2 * faces) +
                 (kVector + sizeof(std::uint32_t)) * moved;
        break;
      case MeshFormat::kPoints:
        bytes += kVector * vertices + (kVector + 2 * sizeof(std::uint32_t)) * moved;
        break;
    }
  }
  return bytes;
}

}  // namespace crowdface
