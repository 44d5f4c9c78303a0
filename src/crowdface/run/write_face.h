// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "crowdface/cast/face_plan.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/run/job.h"

namespace crowdface {

/// Writes one face outside a crowd's folder: the mesh and, in the same folder, the face's textures,
/// materials and attachments.
/// \param textures  blends the textures of this face; contains no images if textures are not
///                   blended
/// \param positions  #V by 3
/// \throws CannotCreate, IoError.
void write_face(const Job& job, const FaceTextures& textures, const FacePlan& face,
                MeshFormat format, const Positions& positions, const std::filesystem::path& file);

}  // namespace crowdface
