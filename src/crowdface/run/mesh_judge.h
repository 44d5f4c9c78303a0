// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "crowdface/cast/face_judge.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Whether whole meshes are judged once they are built, as the config asks.
bool skin_is_judged(const Job& job);

/// Judges the whole meshes of these recipes. \return none if skin_is_judged says no.
std::unique_ptr<SkinCheck> skin_check(const Job& job, const std::vector<CastFace>& crowd);

/// Builds candidates and judges their meshes while casting; none if the config does not ask for it.
/// Both must outlive it.
MeshDefects mesh_defects(const Job& job, const Prepared& prepared);

/// Warns of faces whose whole mesh goes beyond a limit that their samples kept. \return the warning.
std::vector<std::string> judge_meshes(const Job& job, const std::vector<CastFace>& crowd,
                                      const std::vector<FaceFiles>& files);

}  // namespace crowdface
