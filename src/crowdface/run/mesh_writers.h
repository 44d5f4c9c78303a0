// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/config/config.h"
#include "crowdface/core/contains.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/io/obj_template.h"
#include "crowdface/io/ply_template.h"
#include "crowdface/io/usda_template.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/glb_attachments.h"
#include "crowdface/run/level_writer.h"
#include "crowdface/run/usd_attachments.h"
#include "crowdface/run/worn_level.h"
#include "crowdface/shapes/point_carrier.h"

namespace crowdface {

/// A face in one format, or one of its shapes, ready to be written.
struct EncodedMesh {
  MeshName name;
  EncodedFile file;
};

/// The files that each face has in these formats, the faces' own first. With shapes an OBJ file has
/// one beside it for each of them, and points have their displacements; a GLB file holds them.
/// Those of levels of detail follow, level by level, but for points, which have no faces.
std::vector<MeshName> mesh_names(const std::vector<MeshFormat>& formats, const Inputs& inputs);

/// The `mtllib` line that names material files; nothing if there are none.
/// \param from  where their places are relative to.
std::string library_line(const std::vector<MaterialFile>& files, const std::filesystem::path& from);

/// Writes the faces of a crowd in the formats asked for. What the faces share is prepared once;
/// encoding and writing then need no more than positions, and may be done by different threads.
class MeshWriters {
 public:
  /// \param config, inputs  must outlive this object and all that it encodes.
  /// \param crowd  the recipes of all faces that are to be written.
  /// \param shared  the way from a mesh to what all share, material files, say: ".."; empty: beside it.
  /// \throws InvalidInput if a format cannot hold such a mesh.
  MeshWriters(const Config& config, const Inputs& inputs, std::vector<MeshFormat> formats,
              std::span<const CastFace> crowd, const std::string& shared = {});

  /// The face in each of the formats, in their order, then its shapes (see mesh_names); refers to
  /// this object and to the textures.
  /// \param moves     its displacements in each shape; none where no format holds shapes.
  /// \param textures  files of the face's own pictures, as far as there are any, for GLB; OBJ files name
  ///                  the face's own material file instead.
  /// \param worn      its attachments, for GLB.
  /// \throws InvalidInput if positions are not finite.
  std::vector<EncodedMesh> encode(const CastFace& face, const Positions& positions,
                                  std::span<const Displacements> moves,
                                  std::span<const std::string_view> textures = {},
                                  std::span<const WornAttachment> worn = {}) const;

  /// What faces wear on each level of detail.
  std::span<const WornLevel> worn_on_levels() const { return worn_levels_; }

  /// Whether there are shapes that a format holds.
  bool holds_shapes() const;

  /// What this object itself takes, and what the encoding of one face takes at most.
  std::size_t memory_bytes() const;
  std::size_t encode_bytes() const;

 private:
  LevelAttachments attachments_on(std::size_t level) const;
  void add_obj_templates(const std::vector<Index>& targets, const std::string& shared);
  bool has(MeshFormat format) const { return contains(formats_, format); }
  EncodedFile encode(const MeshName& mesh, const WholeFace& face) const;
  EncodedFile encode_level(const MeshName& mesh, const WholeFace& face) const;
  Positions in_shape(const WholeFace& face, const std::string& name) const;
  bool needs_normals(Index target) const;
  bool had_normals(Index target) const;

  const Config& config_;
  const Inputs& inputs_;
  std::vector<MeshFormat> formats_;
  std::map<Index, ObjTemplate> obj_;  ///< of each head that is a target
  std::map<Index, std::string>
      libraries_;  ///< the line that names its material files, if they lie elsewhere
  std::optional<PlyTemplate> ply_;
  std::optional<GlbTemplate> glb_;
  std::vector<WornLevel> worn_levels_;  ///< #levels
  std::vector<GlbAttachments>
      glb_attachments_;  ///< whole, then on each level; none: there are none
  std::vector<UsdAttachments> usd_attachments_;  ///< likewise
  std::optional<UsdaTemplate> usd_;
  std::vector<MeshName> names_;
  std::optional<PointCarrier> points_, joints_;  ///< if there are any
  std::vector<LevelWriter> levels_;
  std::optional<NormalFans> fans_;  ///< of the vertices, if a format needs normals
};

/// About how many bytes one face takes in these formats.
std::uint64_t estimate_mesh_bytes(const Inputs& inputs, const std::vector<MeshFormat>& formats);

}  // namespace crowdface
