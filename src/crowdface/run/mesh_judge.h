// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/face_files.h"
#include "crowdface/validity/protruding_parts_check.h"

namespace crowdface {

/// Returns whether the config asks for a check of the skin on each whole mesh after the mesh is
/// built.
bool skin_is_judged(const Config& config, const Inputs& inputs);

/// Returns the check that compares the whole mesh of a face with the face's target head.
SkinCheck skin_check(const Config& config, const Inputs& inputs, const std::set<Index>& targets);

/// Returns the check that measures how much area of gums, teeth and other parts (except eyeballs)
/// protrudes through the skin.
ProtrudingPartsCheck protruding_parts_check(const Config& config, const Inputs& inputs);

/// Whether casting builds the whole mesh of each candidate face to find defects in this mesh.
bool casting_builds_candidate_meshes(const Config& config);

/// Returns a function that builds the mesh of a candidate face and finds defects in this mesh.
/// \param builder  must outlive the result.
MeshDefectFinder mesh_defect_finder(const Config& config, const Inputs& inputs,
                                    const FaceBuilder& builder);

/// Warns about faces whose whole mesh exceeds one of `limits`. Casting accepted these faces because
/// casting checks only sampled vertices.
/// \return one warning, which names the faces; empty if no face exceeds a limit
std::vector<std::string> mesh_warnings(const BelievabilityOptions& limits,
                                       const std::vector<FacePlan>& crowd,
                                       const std::vector<FaceResult>& results);

}  // namespace crowdface
