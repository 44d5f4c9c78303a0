// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/run/attachment_writers.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/face_ledger.h"
#include "crowdface/run/mesh_judge.h"
#include "crowdface/run/mesh_writers.h"
#include "crowdface/run/own_textures.h"
#include "crowdface/run/report.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// The crowd's files as they were written, and what they took.
struct BuiltFaces {
  std::vector<FaceFiles> files;  ///< #faces
  StageBusy busy;
};

/// What is known before heads are prepared and faces cast: a job that cannot fit need not begin.
/// \throws UsageError if inputs and pictures alone take more than `memory` bytes.
void refuse_too_little_memory(const Config& config, const Inputs& inputs, std::uint64_t memory);

/// Makes faces: blends them, judges them, writes and renders them.
class FaceStages {
 public:
  /// \param builder  must outlive this object, as inputs and prepared heads must.
  /// \param textures  of faces' own; likewise.
  /// \param attachments  what faces wear, or null; likewise.
  /// \param shapes   of faces; likewise.
  /// \param crowd    recipes of all faces that may be made.
  /// \param memory  bytes that the whole process may take; sets how many faces are blended together.
  /// \throws UsageError if one face at a time does not fit.
  FaceStages(const Config& config, const Inputs& inputs, const Prepared& prepared,
             const FaceBuilder& builder, const FaceTextures& textures,
             const FaceAttachments* attachments, const FaceShapes& shapes,
             const std::vector<CastFace>& crowd, std::uint64_t memory);

  /// Each face is recorded when all its files are there. All threads blend a group of faces, then each makes
  /// the files of one after the other. The next group begins when there is no face left that nobody is at.
  /// \param renders  may be null: no pictures.
  BuiltFaces build(const CrowdDirectory& directory, const CrowdRenders* renders,
                   const FaceLedger& ledger, const std::vector<CastFace>& faces) const;

 private:
  class Output;

  MeshWriters writers_;
  const FaceBuilder& builder_;
  const FaceTextures& textures_;
  const FaceAttachments* attachments_;
  const FaceShapes& shapes_;
  AttachmentWriters attachment_writers_;
  std::optional<OwnTextures> own_;  ///< none: faces have no textures of their own
  std::span<const MeshFormat> formats_;
  std::optional<SkinCheck> check_;  ///< none: no mesh is judged
  std::size_t at_once_;
  std::uint64_t waiting_bytes_;  ///< of files that are ready, at most
  std::uint64_t encoded_bytes_;  ///< of all files that are not written, at most
};

}  // namespace crowdface
