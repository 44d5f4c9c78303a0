// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/face_files.h"
#include "crowdface/validity/parts_through_skin.h"

namespace crowdface {

/// Returns whether the config asks for whole meshes to be judged after they are built.
bool skin_is_judged(const Config& config, const Inputs& inputs);

/// Compares whole meshes with their target heads.
SkinCheck skin_check(const Config& config, const Inputs& inputs, const std::set<Index>& targets);

/// Measures the area of gums, teeth and other parts (except eyeballs) that protrudes through the
/// skin.
PartsThroughSkin parts_through_skin(const Config& config, const Inputs& inputs);

/// Whether casting builds candidates and judges their whole meshes.
bool candidates_are_built(const Config& config);

/// A function that builds candidates and judges their meshes. \param builder  must outlive the
/// result.
FindMeshDefects mesh_defects(const Config& config, const Inputs& inputs,
                             const FaceBuilder& builder);

/// Warns about faces whose whole mesh exceeds a limit, although their sampled vertices do not
/// exceed it. \return the warning.
std::vector<std::string> mesh_warnings(const BelievabilityOptions& limits,
                                       const std::vector<FacePlan>& crowd,
                                       const std::vector<FaceResult>& files);

}  // namespace crowdface
