// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/plain_obj_template.h"
#include "crowdface/io/ply_template.h"
#include "crowdface/io/usda_template.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/glb_attachments.h"
#include "crowdface/run/usd_attachments.h"
#include "crowdface/run/worn_level.h"

namespace crowdface {

/// A face as it is on all levels of detail.
struct WholeFace {
  const std::string& id;
  Index target;
  const Positions& positions;            ///< #V by 3, in an OBJ file of a shape those of the shape
  const Positions& normals;              ///< #V by 3, or none where no format needs them
  std::span<const Displacements> moves;  ///< #shapes, or none
  std::span<const std::string_view> textures;  ///< files of its own pictures, or none …
  std::span<const std::string> texture_names;  ///< … and where they lie, from its mesh
  const Positions& points;                     ///< that follow it, or none
  const Positions& joints;                     ///< of its rig, or none
  std::span<const WornAttachment> worn;        ///< what it wears
};

/// What files of faces on a level hold of attachments; null where they have none.
struct LevelAttachments {
  const WornLevel& worn;
  const GlbAttachments* glb = nullptr;
  const UsdAttachments* usd = nullptr;
};

/// The materials of a level's faces, runs of one after the other, as face_materials has them of the whole mesh.
std::vector<MaterialRange> material_ranges(const FaceMaterials& materials,
                                           const std::vector<std::uint32_t>& faces);

/// Writes faces on one level of detail, in the formats that hold faces.
class LevelWriter {
 public:
  /// \param inputs   must outlive this object and all that it encodes.
  /// \param level    from 1
  /// \param targets  of all faces that will be encoded.
  /// \param shared   as MeshWriters takes it
  /// \param worn     must outlive this object, too.
  LevelWriter(const Config& config, const Inputs& inputs, std::size_t level,
              const std::vector<MeshFormat>& formats, const std::vector<Index>& targets,
              const std::string& shared, const LevelAttachments& worn);

  /// \param name  of this level, no points. \param ply_normals  whether PLY files have any.
  EncodedFile encode(const MeshName& name, const WholeFace& face, bool ply_normals) const;

  /// What this object itself takes, and what the encoding of one face takes at most.
  std::size_t memory_bytes() const;
  std::size_t encode_bytes() const;

 private:
  void add_obj_templates(const std::vector<Index>& targets);

  const Inputs& inputs_;
  const DetailLevel& level_;
  LevelAttachments worn_;
  std::vector<PlainObjTemplate> obj_;    ///< one for targets whose materials are the same
  std::map<Index, std::size_t> obj_of_;  ///< of a target
  std::optional<PlyTemplate> ply_;
  std::optional<GlbTemplate> glb_;
  std::optional<UsdaTemplate> usd_;
};

}  // namespace crowdface
