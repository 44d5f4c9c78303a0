// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/run/face_encoders.h"
#include "crowdface/run/report.h"

namespace crowdface {

/// Computes the data that a face's files contain in addition to the blended positions.
struct FaceFinisher {
  const FaceTextures& textures;        ///< blends a face's textures
  const FaceAttachments& attachments;  ///< places attachments on a face
  const FaceShapes& shapes;            ///< transfers blend shapes to a face
  /// the object that encodes the face's mesh files; null: no meshes are written
  const FaceEncoders* encoders = nullptr;
  /// the object that renders images of the face; null: nothing is rendered
  const CrowdRenders* renders = nullptr;

  /// Completes a blended face: adds shapes, attachments, textures and renders. The renders are the
  /// same whether the positions come from blending or from the face's mesh file. Thread-safe.
  /// \param face  must not move in memory afterwards
  /// \param busy  time of each stage, to which this function adds the time that the stage takes
  void finish(FinishedFace& face, StageTimes& busy) const;

 private:
  /// Computes the body's texture, and encodes it if mesh files are written.
  void paint_body(FinishedFace& face, StageTimes& busy) const;
  /// Blends a face's textures. Encodes them into `files` if texture files are written.
  /// \return the textures that renders need
  std::optional<FaceTextureSet> paint(const Recipe& recipe, FaceTextureEncoder::Encoded& files,
                                      StageTimes& busy) const;
};

}  // namespace crowdface
