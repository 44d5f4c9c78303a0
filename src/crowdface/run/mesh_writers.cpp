// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/mesh_writers.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/run/glb_form.h"
#include "crowdface/run/own_textures.h"

namespace crowdface {
namespace {

EncodedFile encode_points(const std::vector<std::string>& names, const Positions& points,
                          const std::string& id) {
  require_finite(points, static_cast<Index>(names.size()), id);
  std::string text = concat("{\n  \"face\": \"", id, "\",\n  \"points\": {\n");
  for (std::size_t p = 0; p < names.size(); ++p) {
    std::string row = usda_rows(points.row(static_cast<Index>(p)));
    row.front() = '[';
    row.back() = ']';
    text += concat("    \"", names[p], "\": ", row, p + 1 < names.size() ? ",\n" : "\n");
  }
  EncodedFile file;
  file.add(text + "  }\n}\n");
  return file;
}

std::size_t normals_bytes(const Topology& topology) {
  return static_cast<std::size_t>(topology.vertex_count + topology.face_count()) * 3 *
         sizeof(double);
}

}  // namespace

std::string part_of(const MeshName& name) {
  std::string part;
  const auto add = [&](const std::string& word) {
    if (!word.empty()) part += concat(part.empty() ? "" : "+", word);
  };
  if (name.level > 0) add(concat("LOD", name.level));
  add(name.attachment);
  add(name.shape);
  return part;
}

std::string file_end(const MeshName& name) {
  const std::string part = part_of(name);
  if (part == kFollowingPoints) return concat('+', part);
  return concat(part.empty() ? "" : "+", part, extension_of(name.format));
}

std::string library_line(const std::vector<MaterialFile>& files,
                         const std::filesystem::path& from) {
  std::string line;
  for (const MaterialFile& file : files) {
    if (!file.is_library) continue;
    line += concat(line.empty() ? "mtllib " : " ", (from / file.relative).generic_string());
  }
  return line;
}

std::filesystem::path mesh_path(const CrowdDirectory& directory, const std::string& id,
                                const MeshName& name) {
  return directory.meshes_of(id) / (id + file_end(name));
}

std::vector<MeshName> mesh_names(const std::vector<MeshFormat>& formats, const Inputs& inputs) {
  std::vector<MeshName> names;
  const std::vector<Shape>& shapes = inputs.shapes.shapes;
  for (std::size_t level = 0; level <= inputs.levels.size(); ++level) {
    for (const MeshFormat format : formats) {
      if (level == 0 || format != MeshFormat::kPoints) names.push_back({format, {}, level});
    }
    for (const MeshFormat format : formats) {
      if (format == MeshFormat::kPoints && level == 0 && !shapes.empty()) {
        names.push_back({format, kAllShapes});
      }
      if (format != MeshFormat::kObj) continue;
      for (const Shape& shape : shapes) names.push_back({format, shape.name, level});
    }
  }
  if (!inputs.points.empty() && !formats.empty()) {
    names.push_back({MeshFormat::kPoints, kFollowingPoints});
  }
  return names;
}

MeshWriters::MeshWriters(const Config& config, const Inputs& inputs,
                         std::vector<MeshFormat> formats, std::span<const CastFace> crowd,
                         const std::string& shared)
    : config_(config),
      inputs_(inputs),
      formats_(std::move(formats)),
      worn_levels_(worn_levels(inputs, crowd)),
      names_(mesh_names(formats_, inputs)) {
  const FaceSet& faces = inputs.faces;
  std::set<Index> targets;
  for (const CastFace& face : crowd) targets.insert(face.recipe.target);
  const bool need_normals =
      std::ranges::any_of(targets, [&](Index target) { return needs_normals(target); });
  const std::vector<Index> all_targets(targets.begin(), targets.end());
  if (has(MeshFormat::kObj)) add_obj_templates(all_targets, shared);
  if (has(MeshFormat::kPly)) ply_.emplace(faces.topology);
  if (has(MeshFormat::kGlb)) {
    glb_.emplace(faces.topology, faces.uvs, glb_options(config, inputs));
    if (!inputs.attachments.empty()) glb_attachments_ = glb_attachments(inputs, worn_levels_);
  }
  if (has(MeshFormat::kUsd)) {
    usd_.emplace(faces.topology, faces.uvs, glb_options(config, inputs, shared),
                 config.output.subdivision);
    if (!inputs.attachments.empty()) {
      usd_attachments_ = usd_attachments(inputs, shared.empty() ? "." : shared, worn_levels_);
    }
  }
  if (need_normals) fans_.emplace(faces.topology);
  if (!inputs.points.empty()) points_.emplace(inputs.points, inputs.parts, skin_vertices(inputs));
  if (!inputs.rig.empty() && glb_)
    joints_.emplace(inputs.rig.points, inputs.parts, skin_vertices(inputs));
  for (std::size_t level = 1; level <= inputs.levels.size(); ++level) {
    levels_.emplace_back(config, inputs, level, formats_, all_targets, shared,
                         attachments_on(level));
  }
}

LevelAttachments MeshWriters::attachments_on(std::size_t level) const {
  LevelAttachments on{worn_levels_[level - 1]};
  if (!glb_attachments_.empty()) on.glb = &glb_attachments_[level];
  if (!usd_attachments_.empty()) on.usd = &usd_attachments_[level];
  return on;
}

void MeshWriters::add_obj_templates(const std::vector<Index>& targets, const std::string& shared) {
  std::vector<std::optional<ObjTemplate>> forms(targets.size());
  parallel_for_each(targets.size(), [&](std::size_t t) {
    forms[t].emplace(inputs_.files[static_cast<std::size_t>(targets[t])], inputs_.faces.topology);
  });
  for (std::size_t t = 0; t < targets.size(); ++t) {
    obj_.emplace(targets[t], std::move(*forms[t]));
    if (shared.empty()) continue;
    const ObjFile& file = inputs_.files[static_cast<std::size_t>(targets[t])];
    libraries_[targets[t]] =
        library_line(find_material_files(file.path, file.material_libraries).files, shared);
  }
}

bool MeshWriters::holds_shapes() const {
  return !inputs_.shapes.shapes.empty() && std::ranges::any_of(formats_, [](MeshFormat format) {
    return format != MeshFormat::kPly;
  });
}

bool MeshWriters::had_normals(Index target) const {
  return !inputs_.files[static_cast<std::size_t>(target)].corner_normals.empty();
}

/// Those of an OBJ file are its own affair: several may meet at a vertex.
bool MeshWriters::needs_normals(Index target) const {
  return has(MeshFormat::kGlb) || has(MeshFormat::kUsd) ||
         (has(MeshFormat::kPly) && had_normals(target)) ||
         (has(MeshFormat::kObj) && !inputs_.levels.empty());
}

Positions MeshWriters::in_shape(const WholeFace& face, const std::string& name) const {
  const std::vector<Shape>& shapes = inputs_.shapes.shapes;
  const auto shape = std::ranges::find(shapes, name, &Shape::name);
  Positions moved = face.positions;
  face.moves[static_cast<std::size_t>(shape - shapes.begin())].add_to(moved);
  return moved;
}

EncodedFile MeshWriters::encode_level(const MeshName& mesh, const WholeFace& face) const {
  const LevelWriter& level = levels_[mesh.level - 1];
  if (mesh.format != MeshFormat::kObj || mesh.shape.empty()) {
    return level.encode(mesh, face, had_normals(face.target));
  }
  const Positions moved = in_shape(face, mesh.shape);
  const Positions normals = vertex_normals(*fans_, inputs_.faces.topology, moved);
  const WholeFace acting{face.id,       face.target,        moved,       normals,     face.moves,
                         face.textures, face.texture_names, face.points, face.joints, face.worn};
  return level.encode(mesh, acting, had_normals(face.target));
}

EncodedFile MeshWriters::encode(const MeshName& mesh, const WholeFace& face) const {
  if (mesh.level > 0) return encode_level(mesh, face);
  const auto& [id, target, positions, normals, moves, textures, texture_names, points, joints,
               worn] = face;
  switch (mesh.format) {
    case MeshFormat::kObj: {
      if (mesh.shape.empty()) return obj_.at(target).encode(positions, id);
      return obj_.at(target).encode(in_shape(face, mesh.shape), concat(id, ", ", mesh.shape));
    }
    case MeshFormat::kPly:
      return ply_->encode(positions, had_normals(target) ? normals : Positions(), id);
    case MeshFormat::kGlb: {
      std::vector<PlacedGlbPart> parts;
      if (!glb_attachments_.empty()) parts = glb_attachments_[0].parts(worn);
      return glb_->encode(positions, normals, id, moves, textures, points, parts, joints);
    }
    case MeshFormat::kUsd: {
      std::vector<PlacedUsdaPart> parts;
      if (!usd_attachments_.empty()) parts = usd_attachments_[0].parts(worn);
      return usd_->encode(positions, normals, id, moves, texture_names, points, parts);
    }
    case MeshFormat::kPoints:
      break;
  }
  if (mesh.shape == kFollowingPoints) return encode_points(inputs_.points.names, points, id);
  return mesh.shape.empty() ? encode_npy(positions, id) : encode_npy(moves, id);
}

std::vector<EncodedMesh> MeshWriters::encode(const CastFace& face, const Positions& positions,
                                             std::span<const Displacements> moves,
                                             std::span<const std::string_view> textures,
                                             std::span<const WornAttachment> worn) const {
  Positions normals;
  if (needs_normals(face.recipe.target)) {
    normals = vertex_normals(*fans_, inputs_.faces.topology, positions);
  }
  Positions points;
  if (points_) points = points_->carry(face.recipe.target, positions);
  Positions joints;
  if (joints_) joints = joints_->carry(face.recipe.target, positions);
  const std::vector<std::string> texture_names = own_texture_names(config_, inputs_, face.id);
  const WholeFace whole{face.id,  face.recipe.target, positions, normals, moves,
                        textures, texture_names,      points,    joints,  worn};
  std::vector<EncodedMesh> meshes;
  for (const MeshName& name : names_) {
    meshes.push_back({name, encode(name, whole)});
    if (name.format != MeshFormat::kObj) continue;
    const auto shared = libraries_.find(face.recipe.target);
    if (has_own_textures(inputs_)) {
      meshes.back().file.replace_line("mtllib", concat("mtllib ", material_file_name(face.id)));
    } else if (shared != libraries_.end() && !shared->second.empty()) {
      meshes.back().file.replace_line("mtllib", shared->second);
    }
  }
  return meshes;
}

std::size_t MeshWriters::memory_bytes() const {
  std::size_t bytes = fans_ ? fans_->memory_bytes() : 0;
  for (const auto& [target, form] : obj_) bytes += form.memory_bytes();
  if (ply_) bytes += ply_->memory_bytes();
  if (glb_) bytes += glb_->memory_bytes();
  if (!glb_attachments_.empty()) bytes += glb_attachments_[0].memory_bytes();
  if (usd_) bytes += usd_->memory_bytes();
  if (!usd_attachments_.empty()) bytes += usd_attachments_[0].memory_bytes();
  for (const LevelWriter& level : levels_) bytes += level.memory_bytes();
  return bytes;
}

std::size_t MeshWriters::encode_bytes() const {
  std::size_t obj = 0;
  for (const auto& [target, form] : obj_) obj = std::max(obj, form.encode_bytes());
  if (has(MeshFormat::kObj)) obj *= 1 + inputs_.shapes.shapes.size();
  std::size_t bytes = (holds_shapes() ? 2 * displacement_bytes(inputs_.shapes) : 0) + obj +
                      (fans_ ? normals_bytes(inputs_.faces.topology) : 0);
  if (ply_) bytes += ply_->encode_bytes();
  if (glb_) bytes += glb_->encode_bytes();
  if (usd_) bytes += usd_->encode_bytes();
  if (!usd_attachments_.empty()) bytes += usd_bytes_worn_at_most(usd_attachments_[0]);
  for (const LevelWriter& level : levels_) bytes += level.encode_bytes();
  if (has(MeshFormat::kPoints)) bytes += npy_encode_bytes(inputs_.faces.topology.vertex_count);
  return bytes;
}

std::uint64_t estimate_mesh_bytes(const Inputs& inputs, const std::vector<MeshFormat>& formats) {
  const auto vertices = static_cast<std::uint64_t>(inputs.faces.topology.vertex_count);
  const auto faces = static_cast<std::uint64_t>(inputs.faces.topology.face_count());
  const auto corners = static_cast<std::uint64_t>(inputs.faces.topology.corner_count());
  constexpr std::uint64_t kVector = 3 * sizeof(float);
  std::uint64_t obj = 0, bytes = 0, moved = 0;
  double levels = 1;
  for (const MeasuredLevel& level : inputs.levels) levels += level.level.share;
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
      case MeshFormat::kUsd:  // a number takes some ten characters, an index six
        bytes += 10 * (6 * vertices + 2 * static_cast<std::uint64_t>(inputs.faces.uvs.rows())) +
                 12 * corners + 36 * moved;
        break;
      case MeshFormat::kPoints:
        bytes += kVector * vertices + (kVector + 2 * sizeof(std::uint32_t)) * moved;
        break;
    }
  }
  return static_cast<std::uint64_t>(levels * static_cast<double>(bytes));
}

}  // namespace crowdface
