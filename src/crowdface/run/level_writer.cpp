// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/level_writer.h"

#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/run/glb_form.h"

namespace crowdface {
namespace {

/// As face_materials has them of the whole mesh; runs of one material after the other.
std::vector<MaterialRange> material_ranges(const FaceMaterials& materials,
                                           const std::vector<std::uint32_t>& faces) {
  std::vector<MaterialRange> ranges;
  if (materials.of_face.empty()) return ranges;
  for (std::size_t t = 0; t < faces.size(); ++t) {
    const std::string& name = materials.names[materials.of_face[faces[t]]];
    if (name.empty() || (!ranges.empty() && ranges.back().name == name)) continue;
    ranges.push_back({name, static_cast<Index>(t)});
  }
  return ranges;
}

}  // namespace

LevelWriter::LevelWriter(const Config& config, const Inputs& inputs, std::size_t level,
                         const std::vector<MeshFormat>& formats)
    : inputs_(inputs), level_(inputs.levels[level - 1].level) {
  for (const MeshFormat format : formats) {
    if (format == MeshFormat::kObj) {
      obj_.emplace(level_.topology, level_.uvs, material_ranges(inputs.materials, level_.faces),
                   PlainObjTemplate::Normals::kVertex);
    } else if (format == MeshFormat::kPly) {
      ply_.emplace(level_.topology);
    } else if (format == MeshFormat::kGlb) {
      glb_.emplace(level_.topology, level_.uvs,
                   glb_options(glb_options(config, inputs), level_, inputs.shapes));
    } else if (format == MeshFormat::kUsd) {
      usd_.emplace(level_.topology, level_.uvs,
                   glb_options(glb_options(config, inputs), level_, inputs.shapes),
                   Subdivision::kNone);  // it is coarse on purpose
    }
  }
}

EncodedFile LevelWriter::encode(const MeshName& name, const WholeFace& face,
                                bool ply_normals) const {
  const std::string id = concat(face.id, "_LOD", name.level);
  const Positions positions = level_.of(face.positions);
  if (name.format == MeshFormat::kPly) {
    return ply_->encode(positions, ply_normals ? level_.of(face.normals) : Positions(), id);
  }
  const Positions normals = level_.of(face.normals);
  if (name.format == MeshFormat::kGlb || name.format == MeshFormat::kUsd) {
    std::vector<Displacements> moves;
    for (const Displacements& shape : face.moves) moves.push_back(level_.of(shape));
    return name.format == MeshFormat::kGlb
               ? glb_->encode(positions, normals, id, moves, face.textures)
               : usd_->encode(positions, normals, id, moves, face.texture_names);
  }
  require(name.format == MeshFormat::kObj, "LevelWriter: a format without faces");
  std::string head;
  for (const std::string& library :
       inputs_.files[static_cast<std::size_t>(face.target)].material_libraries) {
    head += concat("mtllib ", library, '\n');
  }
  head += concat("o ", id, '\n');
  return obj_->encode(head, positions, normals, concat(id, ", ", name.shape));
}

std::size_t LevelWriter::memory_bytes() const {
  return (obj_ ? obj_->memory_bytes() : 0) + (ply_ ? ply_->memory_bytes() : 0) +
         (glb_ ? glb_->memory_bytes() : 0) + (usd_ ? usd_->memory_bytes() : 0);
}

std::size_t LevelWriter::encode_bytes() const {
  return (obj_ ? (1 + inputs_.shapes.shapes.size()) * obj_->encode_bytes() : 0) +
         (ply_ ? ply_->encode_bytes(PlyTemplate::Normals::kVertex) : 0) +
         (glb_ ? glb_->encode_bytes() : 0) + (usd_ ? usd_->encode_bytes() : 0);
}

}  // namespace crowdface
