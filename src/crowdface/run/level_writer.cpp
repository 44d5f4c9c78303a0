// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/level_writer.h"

#include <algorithm>

#include "crowdface/core/text.h"
#include "crowdface/run/glb_form.h"

namespace crowdface {
namespace {

bool is_same(const MaterialRange& a, const MaterialRange& b) {
  return a.name == b.name && a.first_face == b.first_face;
}

}  // namespace

std::vector<MaterialRange> material_ranges(const FaceMaterials& materials,
                                           const std::vector<std::uint32_t>& faces) {
  std::vector<MaterialRange> ranges;
  for (std::size_t t = 0; t < faces.size(); ++t) {
    const std::string& name = materials.names[materials.of_face[faces[t]]];
    if (name.empty() || (!ranges.empty() && ranges.back().name == name)) continue;
    ranges.push_back({name, static_cast<Index>(t)});
  }
  return ranges;
}

LevelWriter::LevelWriter(const Config& config, const Inputs& inputs, std::size_t level,
                         const std::vector<MeshFormat>& formats, const std::vector<Index>& targets,
                         const std::string& shared, const LevelAttachments& worn)
    : inputs_(inputs), level_(inputs.levels[level - 1].level), worn_(worn) {
  for (const MeshFormat format : formats) {
    if (format == MeshFormat::kObj) {
      add_obj_templates(targets);
    } else if (format == MeshFormat::kPly) {
      ply_.emplace(level_.topology);
    } else if (format == MeshFormat::kGlb) {
      glb_.emplace(level_.topology, level_.uvs,
                   glb_options(glb_options(config, inputs), level_, inputs.shapes));
    } else if (format == MeshFormat::kUsd) {
      usd_.emplace(level_.topology, level_.uvs,
                   glb_options(glb_options(config, inputs, shared), level_, inputs.shapes),
                   Subdivision::kNone);  // it is coarse on purpose
    }
  }
}

void LevelWriter::add_obj_templates(const std::vector<Index>& targets) {
  std::vector<std::vector<MaterialRange>> known;
  for (const Index target : targets) {
    const FaceMaterials materials =
        face_materials(inputs_.files[static_cast<std::size_t>(target)].materials,
                       inputs_.faces.topology.face_count());
    const std::vector<MaterialRange> ranges = material_ranges(materials, level_.faces);
    const auto same = std::find_if(known.begin(), known.end(), [&](const auto& others) {
      return std::equal(others.begin(), others.end(), ranges.begin(), ranges.end(), is_same);
    });
    obj_of_[target] = static_cast<std::size_t>(same - known.begin());
    if (same != known.end()) continue;
    known.push_back(ranges);
    obj_.emplace_back(level_.topology, level_.uvs, ranges, PlainObjTemplate::Normals::kVertex);
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
    const std::vector<WornAttachment> worn = worn_.worn.of(face.worn);
    if (name.format == MeshFormat::kGlb) {
      std::vector<PlacedGlbPart> parts;
      if (worn_.glb != nullptr) parts = worn_.glb->parts(worn);
      return glb_->encode(positions, normals, id, moves, face.textures, {}, parts, face.joints);
    }
    std::vector<PlacedUsdaPart> parts;
    if (worn_.usd != nullptr) parts = worn_.usd->parts(worn);
    return usd_->encode(positions, normals, id, moves, face.texture_names, {}, parts);
  }
  std::string head;
  for (const std::string& library :
       inputs_.files[static_cast<std::size_t>(face.target)].material_libraries) {
    head += concat("mtllib ", library, '\n');
  }
  head += concat("o ", id, '\n');
  return obj_[obj_of_.at(face.target)].encode(head, positions, normals,
                                              concat(id, ", ", name.shape));
}

std::size_t LevelWriter::memory_bytes() const {
  std::size_t bytes = 0;
  for (const PlainObjTemplate& obj : obj_) bytes += obj.memory_bytes();
  return bytes + (ply_ ? ply_->memory_bytes() : 0) + (glb_ ? glb_->memory_bytes() : 0) +
         (usd_ ? usd_->memory_bytes() : 0) +
         (worn_.glb != nullptr ? worn_.glb->memory_bytes() : 0) +
         (worn_.usd != nullptr ? worn_.usd->memory_bytes() : 0);
}

std::size_t LevelWriter::encode_bytes() const {
  std::size_t obj = 0;
  for (const PlainObjTemplate& form : obj_) obj = std::max(obj, form.encode_bytes());
  return (1 + inputs_.shapes.shapes.size()) * obj + (ply_ ? ply_->encode_bytes() : 0) +
         (glb_ ? glb_->encode_bytes() : 0) + (usd_ ? usd_->encode_bytes() : 0) +
         (worn_.usd != nullptr ? usd_bytes_worn_at_most(*worn_.usd) : 0);
}

}  // namespace crowdface
