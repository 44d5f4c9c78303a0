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

/// What finishes the faces of a crowd.
struct FaceFinisher {
  const FaceTextures& textures;
  const FaceAttachments& attachments;
  const FaceShapes& shapes;
  const FaceEncoders* encoders = nullptr;  ///< null: no meshes are written
  const CrowdRenders* renders = nullptr;   ///< null: there are no pictures

  /// Makes of a blended face all that its files hold: its shapes, what it wears, its textures and its pictures. A
  /// picture is the same whether the positions come from blending or from the face's mesh file. Any thread may ask.
  /// \param face  must stay where it is.
  void finish(FinishedFace& face, StageBusy& busy) const;

 private:
  std::optional<OwnCoat> paint(const Recipe& recipe, OwnTextures::Encoded& files,
                               StageBusy& busy) const;
};

}  // namespace crowdface
