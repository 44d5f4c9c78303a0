// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "crowdface/cast/cast_face.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Writes one face by itself: the mesh, and beside it what a crowd's folder has beside it, textures and
/// materials of its own, and its attachments.
/// \param textures   blends those, or null: it has none
/// \param positions  #V by 3
/// \throws CannotCreate, IoError
void write_face(const Job& job, const FaceTextures& textures, const CastFace& face,
                MeshFormat format, const Positions& positions, const std::filesystem::path& file);

}  // namespace crowdface
