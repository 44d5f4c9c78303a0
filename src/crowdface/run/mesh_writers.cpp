// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/mesh_writers.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/npy.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/surface_kind.h"

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

GlbOptions glb_options(const Config& config, const Inputs& inputs) {
  GlbOptions options;
  options.unit = config.faces.units;
  options.up = config.faces.up;
  options.front = config.faces.front;
  for (const std::string& name : inputs.materials.names) {
    options.materials.push_back(glb_material(name));
  }
  options.face_materials = inputs.materials.of_face;
  return options;
}

std::size_t normals_bytes(const Topology& topology) {
  return static_cast<std::size_t>(topology.vertex_count + topology.face_count()) * 3 *
         sizeof(double);
}

}  // namespace

MeshWriters::MeshWriters(const Config& config, const Inputs& inputs,
                         std::vector<MeshFormat> formats, std::span<const CastFace> crowd)
    : inputs_(inputs), formats_(std::move(formats)) {
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

std::vector<EncodedMesh> MeshWriters::encode(const CastFace& face,
                                             const Positions& positions) const {
  const std::string& id = face.id;
  Positions normals;
  if (needs_normals(face.recipe.target)) {
    normals = vertex_normals(*fans_, inputs_.faces.topology, positions);
  }
  std::vector<EncodedMesh> meshes;
  for (const MeshFormat format : formats_) {
    switch (format) {
      case MeshFormat::kObj:
        meshes.push_back({format, obj_.at(face.recipe.target).encode(positions, id)});
        break;
      case MeshFormat::kPly:
        meshes.push_back(
            {format,
             ply_->encode(positions, had_normals(face.recipe.target) ? normals : Positions(), id)});
        break;
      case MeshFormat::kGlb:
        meshes.push_back({format, glb_->encode(positions, normals, id)});
        break;
      case MeshFormat::kPoints:
        meshes.push_back({format, encode_npy(positions, id)});
        break;
    }
  }
  return meshes;
}

std::size_t MeshWriters::memory_bytes() const {
  std::size_t bytes = fans_ ? fans_->memory_bytes() : 0;
  for (const auto& [target, form] : obj_) bytes += form.memory_bytes();
  if (ply_) bytes += ply_->memory_bytes();
  if (glb_) bytes += glb_->memory_bytes();
  return bytes;
}

std::size_t MeshWriters::encode_bytes() const {
  std::size_t obj = 0;
  for (const auto& [target, form] : obj_) obj = std::max(obj, form.encode_bytes());
  std::size_t bytes = obj + (fans_ ? normals_bytes(inputs_.faces.topology) : 0);
  if (ply_) bytes += ply_->encode_bytes(PlyTemplate::Normals::kVertex);
  if (glb_) bytes += glb_->encode_bytes();
  if (has(MeshFormat::kPoints)) bytes += npy_encode_bytes(inputs_.faces.topology.vertex_count);
  return bytes;
}

MeshFile write_mesh(const EncodedMesh& mesh, const std::filesystem::path& path) {
  mesh.file.write(path);
  return {mesh.format, mesh.file.digest(), mesh.file.size()};
}

std::uint64_t estimate_mesh_bytes(const Inputs& inputs, const std::vector<MeshFormat>& formats) {
  const auto vertices = static_cast<std::uint64_t>(inputs.faces.topology.vertex_count);
  const auto faces = static_cast<std::uint64_t>(inputs.faces.topology.face_count());
  const auto corners = static_cast<std::uint64_t>(inputs.faces.topology.corner_count());
  constexpr std::uint64_t kVector = 3 * sizeof(float);
  std::uint64_t obj = 0, bytes = 0;
  for (const ObjFile& file : inputs.files) obj += file.file.bytes().size();
  for (const MeshFormat format : formats) {
    switch (format) {
      case MeshFormat::kObj:
        bytes += obj / inputs.files.size();
        break;
      case MeshFormat::kPly:
        bytes += kVector * vertices + faces + sizeof(std::uint32_t) * corners;
        break;
      case MeshFormat::kGlb:  // positions, normals, texture coordinates, ids; triangles
        bytes += 3 * kVector * vertices + kVector * (corners - 2 * faces);
        break;
      case MeshFormat::kPoints:
        bytes += kVector * vertices;
        break;
    }
  }
  return bytes;
}

}  // namespace crowdface
