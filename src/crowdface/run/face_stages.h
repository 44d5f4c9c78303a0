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

/// Rejects a job that cannot fit into memory. Called early, before heads are prepared and faces are
/// cast.
/// \throws UsageError if inputs and renders alone need more than `memory_bytes` bytes.
void refuse_too_little_memory(const Config& config, const Inputs& inputs,
                              std::uint64_t memory_bytes);

/// Makes faces: blends the faces, checks them for defects, renders them and writes their files.
class FaceStages {
 public:
  /// All referenced objects except `crowd` must outlive this object.
  /// \param crowd   all faces that may be made
  /// \param memory_bytes  maximum memory of the whole process, in bytes; determines how many faces
  ///                are blended in one batch
  /// \throws UsageError if `memory_bytes` is too small for blending one face at a time.
  FaceStages(const Config& config, const Inputs& inputs, const PreparedHeads& prepared,
             const FaceBuilder& builder, const FaceTextures& textures,
             const FaceAttachments& attachments, const FaceShapes& shapes,
             const std::vector<FacePlan>& crowd, std::uint64_t memory_bytes);

  /// Makes faces. All threads cooperate to blend a group of faces; then each thread takes one face
  /// after the other, finishes and encodes it. The next group starts as soon as threads have taken
  /// all faces of the current group. A face is recorded in the ledger when all its files are
  /// written.
  /// \param renders  null: nothing is rendered
  /// \param results  one per face, output
  /// \param busy     time of each stage, to which this function adds the time that threads spend in
  /// the stage
  void build(const FaceFileLists& lists, const CrowdRenders* renders, const FaceLedger& ledger,
             std::span<const FacePlan* const> faces, std::span<FaceResult* const> results,
             StageTimes& busy) const;

 private:
  class Output;  // finishes a blended face and passes its files to the writer

  FaceEncoders encoders_;
  const FaceBuilder& builder_;
  const FaceTextures& textures_;        ///< blends the faces' textures
  const FaceAttachments& attachments_;  ///< places attachments on the faces
  const FaceShapes& shapes_;            ///< transfers blend shapes to the faces
  /// finds defects in the skin of a face's whole mesh; empty if the config asks for no such check
  std::optional<SkinCheck> check_;
  /// number of faces in a group; all faces of a group are blended together
  std::size_t faces_per_group_;
  /// maximum total size, in bytes, of the encoded files that wait to be written
  std::uint64_t max_waiting_bytes_;
};

}  // namespace crowdface
