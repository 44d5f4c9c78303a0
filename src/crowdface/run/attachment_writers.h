// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crowdface/heads/face_attachments.h"
#include "crowdface/io/obj_template.h"
#include "crowdface/io/plain_obj_template.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/run/mesh_writers.h"
#include "crowdface/run/worn_level.h"

namespace crowdface {

/// Whether attachments have OBJ files of their own beside faces in these formats: those that hold one mesh.
bool attachments_have_files(std::span<const MeshFormat> formats);

/// The files that a face has in these formats: see mesh_names, and after those its attachments'.
std::vector<MeshName> mesh_names_of(const CastFace& face, const std::vector<MeshFormat>& formats,
                                    const Inputs& inputs);

/// Writes attachments as OBJ files: their own, with other positions and the place of their materials.
class AttachmentWriters {
 public:
  /// \param inputs  must outlive this object and all that it encodes. \param formats  of the faces.
  /// \param shared  as MeshWriters takes it \param levels  of detail; must outlive this object, too.
  AttachmentWriters(const Inputs& inputs, std::span<const MeshFormat> formats,
                    const std::string& shared = {}, std::span<const WornLevel> levels = {});

  /// Adds the files of what a face wears, if there are any, whole and then level by level: at rest, and where it bends in
  /// each of the shapes that faces have files of.
  /// \param id  the face's, for messages.
  void add_to(std::vector<EncodedMesh>& meshes, const std::string& id,
              std::span<const WornAttachment> worn) const;

  /// What the encoding of one face's takes at most.
  std::size_t encode_bytes() const;

 private:
  struct Form {
    ObjTemplate obj;
    std::string libraries;  ///< the line that names material files; empty: there is none
  };
  /// Of an attachment on a level.
  struct LevelForm {
    PlainObjTemplate obj;
    std::optional<NormalFans> fans;  ///< none: files have no normals
  };
  using LevelForms = std::map<const Attachment*, LevelForm>;

  template <class Add>
  void add_poses(const WornAttachment& worn, const Add& add) const;
  void add_level(std::vector<EncodedMesh>& meshes, std::size_t level, const std::string& id,
                 std::span<const WornAttachment> worn) const;
  void add_level_forms(const WornLevel& level);

  std::vector<MeshFormat> formats_;
  const Inputs& inputs_;
  std::map<const Attachment*, Form> forms_;
  std::span<const WornLevel> levels_;
  std::vector<LevelForms> level_forms_;  ///< #levels
};

}  // namespace crowdface
