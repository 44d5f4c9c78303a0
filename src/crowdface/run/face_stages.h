// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/face_encoders.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/face_ledger.h"
#include "crowdface/run/mesh_judge.h"
#include "crowdface/run/report.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// What is known before heads are prepared and faces cast: a job that cannot fit need not begin.
/// \throws UsageError if inputs and pictures alone take more than `memory` bytes.
void refuse_too_little_memory(const Config& config, const Inputs& inputs, std::uint64_t memory);

/// Makes faces: blends them, judges them, writes and renders them.
class FaceStages {
 public:
  /// \param builder  must outlive this object, as inputs and prepared heads must.
  /// \param textures  of faces' own; likewise.
  /// \param attachments  what faces wear; likewise.
  /// \param shapes   of faces; likewise.
  /// \param crowd    recipes of all faces that may be made.
  /// \param memory  bytes that the whole process may take; sets how many faces are blended together.
  /// \throws UsageError if one face at a time does not fit.
  FaceStages(const Config& config, const Inputs& inputs, const Prepared& prepared,
             const FaceBuilder& builder, const FaceTextures& textures,
             const FaceAttachments& attachments, const FaceShapes& shapes,
             const std::vector<CastFace>& crowd, std::uint64_t memory);

  /// Each face is recorded when all its files are there. All threads blend a group of faces, then each makes
  /// the files of one after the other. The next group begins when there is no face left that nobody is at.
  /// \param renders  may be null: no pictures. \param busy  how long threads are at it
  /// \param results  one for each face: what is known of it
  void build(const FaceFileLists& lists, const CrowdRenders* renders, const FaceLedger& ledger,
             std::span<const CastFace* const> faces, std::span<FaceResult* const> results,
             StageBusy& busy) const;

 private:
  class Output;

  FaceEncoders encoders_;
  const FaceBuilder& builder_;
  const FaceTextures& textures_;
  const FaceAttachments& attachments_;
  const FaceShapes& shapes_;
  std::optional<SkinCheck> check_;  ///< none: no mesh is judged
  std::size_t at_once_;
  std::uint64_t waiting_bytes_;  ///< of files that are ready, at most
};

}  // namespace crowdface
