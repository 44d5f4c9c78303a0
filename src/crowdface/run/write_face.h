// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "crowdface/cast/face_plan.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Writes one face by itself: the mesh and, next to it, the files that a crowd's folder would have:
/// the face's own textures and materials, and its attachments.
/// \param textures   blends the face's own textures; has none if faces have no own textures
/// \param positions  #V by 3
/// \throws CannotCreate, IoError.
void write_face(const Job& job, const FaceTextures& textures, const FacePlan& face,
                MeshFormat format, const Positions& positions, const std::filesystem::path& file);

}  // namespace crowdface
