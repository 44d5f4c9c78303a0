// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/face_judge.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/face_files.h"

namespace crowdface {

/// Whether whole meshes are judged once they are built, as the config asks.
bool skin_is_judged(const Config& config, const Inputs& inputs);

/// Judges whole meshes against those of the targets.
SkinCheck skin_check(const Config& config, const Inputs& inputs, const std::set<Index>& targets);

/// Whether candidates are built and their meshes judged while casting.
bool candidates_are_built(const Config& config);

/// Builds candidates and judges their meshes. \param builder  must outlive it.
MeshDefects mesh_defects(const Config& config, const Inputs& inputs, const FaceBuilder& builder);

/// Warns of faces whose whole mesh goes beyond a limit that their samples kept. \return the warning.
std::vector<std::string> judge_meshes(const BelievabilityOptions& limits,
                                      const std::vector<CastFace>& crowd,
                                      const std::vector<FaceResult>& files);

}  // namespace crowdface
